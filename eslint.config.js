// ESLint rules of the TypeScript sources: conventions that the type checker does not enforce.

import tseslint from "typescript-eslint";

// The only default export, which eslint requires.
export default tseslint.config(
  { ignores: ["**/dist/", "web/lib/", "build*/", "node_modules/"] },
  {
    files: ["**/*.ts"],
    extends: [tseslint.configs.strictTypeChecked, tseslint.configs.stylisticTypeChecked],
    languageOptions: { parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname } },
    rules: {
      eqeqeq: "error",
      "no-eval": "error",
      "no-implied-eval": "off",
      "@typescript-eslint/no-implied-eval": "error",
      "no-restricted-syntax": [
        "error",
        { selector: "ExportDefaultDeclaration", message: "Name what you export." },
        { selector: "TSEnumDeclaration", message: "Use a union of string literals." },
      ],
      "@typescript-eslint/consistent-type-imports": "error",
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
      // The test runner handles the promises of these calls.
      "@typescript-eslint/no-floating-promises": ["error", { allowForKnownSafeCalls: ["test", "describe", "it"] }],
    },
  },
  {
    // An array that is too short fails the test in any case.
    files: ["tests/browser/**/*.ts", "tests/level*.test.ts", "bench/**/*.ts"],
    rules: { "@typescript-eslint/no-non-null-assertion": "off" },
  },
  {
    // Indices into typed arrays have been checked when they were read; defaults would hide errors.
    files: ["web/src/decode/compact/**/*.ts", "web/src/levels/**/*.ts"],
    rules: { "@typescript-eslint/no-non-null-assertion": "off" },
  },
);
