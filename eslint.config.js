// The rules of the TypeScript sources. Types are checked by tsc; this holds the
// habits that types cannot.
import tseslint from "typescript-eslint";

// eslint asks for a default export here and nowhere else.
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
      // Without it a promise that a test runner or an event handler owns needs noise.
      "@typescript-eslint/no-floating-promises": ["error", { allowForKnownSafeCalls: ["test", "describe", "it"] }],
    },
  },
  {
    // Where a test's own array ends too early, the test fails either way.
    files: ["tests/browser/**/*.ts", "bench/**/*.ts"],
    rules: { "@typescript-eslint/no-non-null-assertion": "off" },
  },
  {
    // Every index into a typed array was checked when it was read; defaults would only hide that.
    files: ["web/src/decode/compact/**/*.ts"],
    rules: { "@typescript-eslint/no-non-null-assertion": "off" },
  },
);
