// SPDX-License-Identifier: MIT

const browser = [
  "document", "window", "getComputedStyle", "URLSearchParams", "ResizeObserver", "Option",
  "HTMLElement", "HTMLInputElement", "HTMLSelectElement", "HTMLButtonElement", "HTMLCanvasElement",
  "HTMLDialogElement", "HTMLFormElement", "HTMLScriptElement", "WheelEvent",
];
const rules = {
  "no-undef": "error",
  "no-unused-vars": "error",
  "no-unreachable": "error",
  "no-dupe-keys": "error",
  "no-const-assign": "error",
  "no-fallthrough": "error",
  "no-self-assign": "error",
  "no-shadow": "error",
  "no-var": "error",
  "prefer-const": "error",
  "eqeqeq": "error",
  "curly": ["error", "multi-or-nest", "consistent"],
  "semi": "error",
  "quotes": ["error", "double", { avoidEscape: true, allowTemplateLiterals: true }],
  "max-len": ["error", { code: 112 }],
  "max-lines": ["error", 400],
  "max-lines-per-function": ["error", 60],
};

export default [
  { ignores: ["**/node_modules/"] },
  {
    files: ["view/page/*.js"],
    languageOptions: {
      ecmaVersion: 2022, sourceType: "module",
      globals: Object.fromEntries(browser.map((name) => [name, "readonly"])),
    },
    rules,
  },
  {
    files: ["tests/view/*.js"],
    languageOptions: {
      ecmaVersion: 2022, sourceType: "module", globals: { process: "readonly", URL: "readonly" },
    },
    rules,
  },
];
