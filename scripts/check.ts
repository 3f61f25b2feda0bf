// Checks types and style of the TypeScript: what `tsc` and `eslint` report, from one program, so that every file is
// parsed and every type is inferred once for both. `node --run types` and `node --run lint` are the two by themselves.

import { readFileSync } from "node:fs";
import { ESLint } from "eslint";
import ts from "typescript";

const configFile = "tsconfig.json";
const { scripts } = JSON.parse(readFileSync("package.json", "utf8")) as { scripts: { lint: string } };
const [, ...linted] = scripts.lint.split(" "); // what `node --run lint` checks

const config = ts.getParsedCommandLineOfConfigFile(configFile, undefined, {
  ...ts.sys,
  onUnRecoverableConfigFileDiagnostic: (diagnostic) => {
    throw new Error(ts.flattenDiagnosticMessageText(diagnostic.messageText, "\n"));
  },
});
if (!config) throw new Error(`${configFile} cannot be read`);
const program = ts.createProgram(config.fileNames, config.options);

const diagnostics = [...config.errors, ...ts.getPreEmitDiagnostics(program)];
process.stdout.write(
  ts.formatDiagnostics(diagnostics, {
    getCanonicalFileName: (name) => name,
    getCurrentDirectory: () => process.cwd(),
    getNewLine: () => "\n",
  }),
);

const eslint = new ESLint({
  overrideConfig: {
    files: ["**/*.ts"],
    languageOptions: { parserOptions: { projectService: false, programs: [program] } },
  },
});
const results = await eslint.lintFiles(linted);
const formatter = await eslint.loadFormatter();
process.stdout.write(await formatter.format(results));

if (diagnostics.length > 0 || results.some(({ errorCount }) => errorCount > 0)) process.exitCode = 1;
