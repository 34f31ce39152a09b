// Bundles the console's page into a table of files for C++.   node build.mjs WORK_FOLDER OUT.cpp
// Packages are installed into WORK_FOLDER as the lock file says, without their scripts.
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

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

// The licence of every package that is in the bundle.
function licences() {
  const { dependencies } = JSON.parse(readFileSync(join(here, "package.json"), "utf8"));
  const { packages } = JSON.parse(readFileSync(join(here, "package-lock.json"), "utf8"));
  const names = Object.entries(packages).filter(([path, entry]) => path && !entry.dev).map(([path]) => path);
  if (names.length < Object.keys(dependencies).length) throw new Error("package-lock.json lacks packages of package.json");
  return names.sort().map((path) => {
    const folder = join(work, path);
    const file = readdirSync(folder).find((name) => /^licen[cs]e/i.test(name));
    if (!file) throw new Error(`${path} has no licence file`);
    return `${path.replace(/^node_modules\//, "")} ${packages[path].version}\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
  }).join("\n----\n\n");
}

function bundle() {
  const { buildSync } = createRequire(join(work, "package.json"))("esbuild");
  const made = buildSync({
    entryPoints: [join(here, "src/main.tsx")], nodePaths: [join(work, "node_modules")], bundle: true, minify: true, write: false,
    format: "esm", target: "es2022", jsx: "automatic", jsxImportSource: "preact", legalComments: "none", logLevel: "warning",
  });
  return made.outputFiles[0].text;
}

function cppTable(files) {
  const arrays = files.map(([, , text], index) => {
    const bytes = [...Buffer.from(text, "utf8")];
    return `constexpr unsigned char kFile${index}[] = {${bytes.join(",")}};`;
  });
  const rows = files.map(([path, type], index) =>
    `      {"${path}", "${type}", {reinterpret_cast<const char*>(kFile${index}), sizeof kFile${index}}},`);
  return ["// Made by clients/web/build.mjs.", '#include "tools/console/page_files.h"', "", "namespace ensonify::console {", "namespace {",
    ...arrays, "}  // namespace", "", "std::vector<PageFile> page_files() {", "  return {", ...rows, "  };", "}", "",
    "}  // namespace ensonify::console", ""].join("\n");
}

install();
writeFileSync(out, cppTable([
  ["/", "text/html; charset=utf-8", readFileSync(join(here, "src/index.html"), "utf8")],
  ["/console.css", "text/css; charset=utf-8", readFileSync(join(here, "src/console.css"), "utf8")],
  ["/console.js", "text/javascript; charset=utf-8", bundle()],
  ["/licences.txt", "text/plain; charset=utf-8", licences()],
]));
