// Checks the page's types.   node check.mjs WORK_FOLDER, where build.mjs has installed the packages
import { execFileSync } from "node:child_process";
import { cpSync, rmSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const work = resolve(process.argv[2]);
rmSync(join(work, "src"), { recursive: true, force: true });
cpSync(join(here, "src"), join(work, "src"), { recursive: true });
cpSync(join(here, "tsconfig.json"), join(work, "tsconfig.json"));
try {
  execFileSync(process.execPath, [join(work, "node_modules/typescript/bin/tsc"), "-p", work], { stdio: "inherit" });
} catch {
  process.exit(1);
}
