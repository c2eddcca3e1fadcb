// Builds the package and the page of the module that `cargo xtask web` has put into
// package/wasm: package/dist and dist.

import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync } from "node:fs";
import { build } from "esbuild";

process.chdir(import.meta.dirname);

const tsc = (folder) => execFileSync(process.execPath, ["node_modules/typescript/bin/tsc", "-p", folder], { stdio: "inherit" });

rmSync("package/dist", { recursive: true, force: true });
tsc("package");
tsc("page");

rmSync("dist", { recursive: true, force: true });
await build({
  entryPoints: ["page/src/main.ts", "page/src/worker.ts"],
  outdir: "dist",
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  sourcemap: true,
  logLevel: "warning",
});
for (const file of ["index.html", "style.css"]) {
  cpSync(`page/${file}`, `dist/${file}`);
}
cpSync("package/wasm/hexdel_web_bg.wasm", "dist/hexdel.wasm");

// The examples are fixtures of the tests, or the page's own.
mkdirSync("dist/examples");
const named = readFileSync("page/src/files.ts", "utf8").matchAll(/file: "([^"]+)"/g);
for (const [, file] of named) {
  const folders = ["page/examples", ...["points", "graphs", "polygons"].map((name) => `../fixtures/${name}`)];
  const from = folders.map((folder) => `${folder}/${file}`).find(existsSync);
  cpSync(from, `dist/examples/${file}`);
}
