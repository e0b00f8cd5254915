// Rules for the page's TypeScript. Exceptions are entries of this file with a reason; comments in the sources have no
// effect.
import { fileURLToPath } from "node:url";
import js from "@eslint/js";
import tseslint from "typescript-eslint";

export default tseslint.config(
  { ignores: ["dist/", "node_modules/"] },
  { linterOptions: { noInlineConfig: true } },
  js.configs.recommended,
  {
    rules: {
      eqeqeq: "error",
      // One statement per line, and no line over 120 characters, also in strings and comments, which prettier does not
      // break.
      curly: ["error", "multi-line"],
      "one-var": ["error", "never"],
      "no-restricted-syntax": [
        "error",
        ...[
          "IfStatement > .consequent",
          "ForStatement > .body",
          "ForOfStatement > .body",
          "WhileStatement > .body",
        ].map((place) => ({
          selector: `${place}[type=/^(If|For|ForOf|While)Statement$/]`,
          message: "Put it in braces.",
        })),
      ],
      "max-len": ["error", 120],
      "max-lines": ["error", 400],
      "max-lines-per-function": ["error", { max: 40, skipComments: true, skipBlankLines: true }],
      "prefer-const": "error",
    },
  },
  {
    files: ["src/**/*.ts"],
    extends: [tseslint.configs.recommendedTypeChecked],
    languageOptions: {
      parserOptions: { projectService: true, tsconfigRootDir: fileURLToPath(new URL(".", import.meta.url)) },
    },
    rules: { "@typescript-eslint/switch-exhaustiveness-check": "error" },
  },
  { files: ["*.mjs"], languageOptions: { globals: { Buffer: "readonly", URL: "readonly", console: "readonly" } } },
);
