// Bundles the console's page into a table of files for C++.   node build.mjs WORK_FOLDER OUT.cpp
// Packages are installed into WORK_FOLDER as the lock file says, without their scripts.
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const [work, out] = process.argv.slice(2).map((path) => resolve(path));

function install() {
  const lock = readFileSync(join(here, "package-lock.json"), "utf8");
  const done = join(work, "installed.json");
  if (existsSync(done) && readFileSync(done, "utf8") === lock) return;
  mkdirSync(work, { recursive: true });
  for (const file of ["package.json", "package-lock.json", ".npmrc"]) copyFileSync(join(here, file), join(work, file));
  execFileSync("npm", ["ci", "--ignore-scripts", "--no-update-notifier"], { cwd: work, stdio: ["ignore", "ignore", "inherit"] });
  writeFileSync(done, lock);
}

function bundle() {
  const { buildSync } = createRequire(join(work, "package.json"))("esbuild");
  const made = buildSync({
    entryPoints: [join(here, "src/main.tsx")], nodePaths: [join(work, "node_modules")], bundle: true, minify: true, write: false,
    format: "esm", target: "es2022", jsx: "automatic", jsxImportSource: "preact", legalComments: "none", logLevel: "warning",
    metafile: true,
  });
  return { text: made.outputFiles[0].text, inputs: Object.entries(Object.values(made.metafile.outputs)[0].inputs).filter(([, { bytesInOutput }]) => bytesInOutput).map(([path]) => path) };
}

// The licence of every package that is in the bundle.
function licences(inputs) {
  const packages = new Set(inputs.map((path) => path.match(/node_modules\/((?:@[^/]+\/)?[^/]+)/)?.[1]).filter(Boolean));
  return [...packages].sort().map((name) => {
    const folder = join(work, "node_modules", name);
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    if (!file) throw new Error(`${name} is in the bundle and has no licence file`);
    const { version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    return `${name} ${version}\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
  }).join("\n----\n\n");
}

function cppTable(files) {
  const array = (name, bytes) => `constexpr unsigned char ${name}[] = {${[...bytes].join(",")}};`;
  const view = (name) => `{reinterpret_cast<const char*>(${name}), sizeof ${name}}`;
  const arrays = files.flatMap(([, , text], i) => {
    const bytes = Buffer.from(text, "utf8");
    return [array(`kFile${i}`, bytes), array(`kCompressed${i}`, gzipSync(bytes, { level: 9 }))];
  });
  const rows = files.map(([path, type], i) => `      {"${path}", "${type}", ${view(`kFile${i}`)}, ${view(`kCompressed${i}`)}},`);
  return ["// Made by clients/web/build.mjs.", '#include "tools/console/page_files.h"', "", "namespace ensonify::console {", "namespace {",
    ...arrays, "}  // namespace", "", "std::vector<PageFile> page_files() {", "  return {", ...rows, "  };", "}", "",
    "}  // namespace ensonify::console", ""].join("\n");
}

install();
const { text, inputs } = bundle();
writeFileSync(out, cppTable([
  ["/", "text/html; charset=utf-8", readFileSync(join(here, "src/index.html"), "utf8")],
  ["/console.css", "text/css; charset=utf-8", [join(work, "node_modules/uplot/dist/uPlot.min.css"), join(here, "src/console.css")].map((file) => readFileSync(file, "utf8")).join("\n")],
  ["/console.js", "text/javascript; charset=utf-8", text],
  ["/licences.txt", "text/plain; charset=utf-8", licences(inputs)],
]));
