// Build of dist/page.html: bundles src/ into one file without network requests. The same lockfile gives the same bytes.
import { build } from "esbuild";
import { mkdir, readFile, writeFile } from "node:fs/promises";

// Shaders of three are strings, and esbuild does not minify strings: this removes their tabs, comments, and blanks
// inside of parentheses.
const shader = (text) =>
  text
    .replace(/(?:\\n|\n)(?:\\t|[\t ])+/g, (s) => (s[0] === "\n" ? "\n" : "\\n"))
    .replace(/(?<=\\n)(?:\/\/[^"\\]*)?\\n/g, "")
    .replace(/(?<=\n)(?:\/\/[^`\n]*)?\n/g, "")
    .replace(/\( +| +\)/g, (s) => s.trim());
const untabbed = {
  name: "untabbed",
  setup: ({ onLoad }) =>
    onLoad({ filter: /three\/build\/three\.\w+\.js$/ }, async ({ path }) => ({
      contents: (await readFile(path, "utf8")).replace(
        /"(?:[^"\\\n]|\\.)*\\n(?:[^"\\\n]|\\.)*"|\/\* glsl \*\/`[^`]*`/g,
        shader,
      ),
      loader: "js",
    })),
};
const here = (path) => new URL(path, import.meta.url);
const bundle = async (entry) => {
  const { outputFiles } = await build({
    absWorkingDir: here(".").pathname,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    charset: "utf8",
    legalComments: "none",
    plugins: [untabbed],
    target: ["chrome115", "firefox115", "safari16.4"],
  });
  return outputFiles[0].text.trim();
};

const licences = [];
for (const name of ["three", "uplot"]) {
  const { version } = JSON.parse(await readFile(here(`node_modules/${name}/package.json`), "utf8"));
  licences.push(`${name} ${version}\n\n${(await readFile(here(`node_modules/${name}/LICENSE`), "utf8")).trim()}\n`);
}
const licenceText = licences.join("\n\n");

// The program replaces the marks TITLE, META and DATA: the page must contain each of them exactly once.
const parts = {
  CSS: (await bundle("src/style.css")).replaceAll("</style", "<\\/style"),
  JS: (await bundle("src/main.ts")).replaceAll("</script", "<\\/script"),
  LICENCES: licenceText.replaceAll("&", "&amp;").replaceAll("<", "&lt;"),
};
let page = (await readFile(here("src/page.html"), "utf8"))
  .replace(/\n\s+/g, "\n") // indentation is only for the source
  .replace(/\n(\/\*[A-Z]+\*\/)\n/g, "$1");
for (const [mark, text] of Object.entries(parts)) page = page.replace(`/*${mark}*/`, () => text);
for (const mark of ["TITLE", "META", "DATA"]) {
  if (page.split(`/*${mark}*/`).length !== 2) throw new Error(`the mark /*${mark}*/ must be in the page once`);
}
await mkdir(here("dist"), { recursive: true });
await writeFile(here("dist/page.html"), page);
await writeFile(here("LICENSES.txt"), licenceText);
console.log(`dist/page.html: ${Buffer.byteLength(page)} bytes (script ${parts.JS.length}, style ${parts.CSS.length})`);
