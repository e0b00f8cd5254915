// Check of the imports of src: a file imports only what the table permits for its folder, and no files import one
// another in a circle. Imports of types count.
import { readdirSync, readFileSync } from "node:fs";
import { join, relative, resolve } from "node:path";
import process from "node:process";
import { fileURLToPath } from "node:url";
import ts from "typescript";

// For each folder of src: the other folders, files of src itself, and packages that its files may import.
const table = {
  colour: [],
  dom: [],
  keyline: ["dom"],
  data: ["three"],
  panel: ["colour", "data"],
  plots: ["colour", "data", "dom", "keyline", "panel", "uplot"],
  scene: ["colour", "data", "dom", "panel", "three"],
  verdict: ["data", "dom", "panel", "plots"],
  address: ["panel"],
  transport: ["data", "dom", "panel"],
  layout: ["dom", "panel", "plots", "verdict"],
  page: ["address", "colour", "data", "dom", "layout", "panel", "scene", "transport", "verdict"],
  film: ["colour", "dom", "page", "scene"],
  controls: ["colour", "dom", "film", "page", "scene"],
  kept: ["colour", "data", "page", "scene"],
  watch: ["dom", "kept", "page"],
  main: ["colour", "controls", "data", "dom", "page", "watch"],
};

const src = fileURLToPath(new URL("src", import.meta.url));
const roomOf = (path) => path.split("/")[0].replace(/\.ts$/, "");

/** Imports of a file: paths in src, and names of packages. */
function importsOf(file) {
  const { importedFiles } = ts.preProcessFile(readFileSync(join(src, file), "utf8"));
  const inSrc = (name) => `${relative(src, resolve(src, file, "..", name))}.ts`;
  return importedFiles.map(({ fileName: name }) => (name.startsWith(".") ? inSrc(name) : name));
}

const files = readdirSync(src, { recursive: true }).filter((file) => file.endsWith(".ts"));
const imports = new Map(files.map((file) => [file, importsOf(file)]));
const arrowsOf = (file) => imports.get(file).map((to) => ({ file, to, arrow: `${roomOf(file)} -> ${roomOf(to)}` }));
const arrows = files.flatMap(arrowsOf).filter(({ file, to }) => roomOf(file) !== roomOf(to));
const permitted = Object.entries(table).flatMap(([room, to]) => to.map((one) => `${room} -> ${one}`));

/** Circles that a search through the imports of a file meets. `path` leads to the file; `seen` has been searched. */
function circlesFrom(file, path, seen) {
  const start = path.indexOf(file);
  if (start >= 0) return [`a circle: ${[...path.slice(start), file].join(" -> ")}`];
  if (seen.has(file)) return [];
  seen.add(file);
  return (imports.get(file) ?? []).flatMap((to) => circlesFrom(to, [...path, file], seen));
}

const seen = new Set();
const wrong = [
  ...arrows
    .filter(({ arrow }) => !permitted.includes(arrow))
    .map(({ file, to, arrow }) => `src/${file} imports ${to}, but the table of arrows.mjs has no ${arrow}`),
  ...permitted
    .filter((one) => !arrows.some(({ arrow }) => arrow === one))
    .map((one) => `no file needs ${one} in the table of arrows.mjs`),
  ...files.flatMap((file) => circlesFrom(file, [], seen)),
];
wrong.forEach((one) => console.error(one));
process.exitCode = wrong.length ? 1 : 0;
