// The package as users get it: packed, and installed in a folder where nothing else is.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { inFolder } from "./native.mjs";

const HERE = import.meta.dirname;
const WEB = join(HERE, "..");

const npm = (folder, ...words) =>
  execFileSync("npm", [...words, "--no-audit", "--no-fund"], { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });

test("the package is whole", (context) => {
  const [packed] = JSON.parse(npm(join(WEB, "package"), "pack", "--dry-run", "--json"));
  const names = packed.files.map(({ path }) => path);
  const needed = ["package.json", "README.md", "LICENSE-MIT", "LICENSE-APACHE", "dist/index.js", "dist/index.d.ts", "dist/node.js"];
  for (const name of [...needed, "wasm/hexdel_web_bg.wasm", "wasm/hexdel_web.js"]) {
    assert.ok(names.includes(name), name);
  }
  context.diagnostic(`${names.length} files, ${packed.size} bytes packed`);
});

test("it installs, type-checks and works", { timeout: 600_000 }, () =>
  inFolder((folder) => {
    npm(join(WEB, "package"), "pack", "--pack-destination", folder);
    const archive = readdirSync(folder).find((name) => name.endsWith(".tgz"));
    assert.ok(statSync(join(folder, archive)).size < 1_500_000);
    writeFileSync(join(folder, "package.json"), '{ "private": true, "type": "module" }');
    npm(folder, "install", "--offline", "--ignore-scripts", `./${archive}`);
    cpSync(join(HERE, "consumer.ts"), join(folder, "consumer.ts"));
    const tsc = [join(WEB, "node_modules/typescript/bin/tsc"), "--noEmit", "--strict", "--skipLibCheck"];
    const mode = ["--module", "nodenext", "--target", "es2022", "--types", "", "--lib", "es2022,dom", "consumer.ts"];
    execFileSync(process.execPath, [...tsc, ...mode], { cwd: folder, stdio: "inherit" });
    cpSync(join(HERE, "consumer.mjs"), join(folder, "consumer.test.mjs"));
    writeFileSync(join(folder, "native.mjs"), `export * from ${JSON.stringify(join(HERE, "native.mjs"))};\n`);
    const tests = ["--test", "--test-reporter=spec", "consumer.test.mjs"];
    // A test within a test would report to the outer one.
    const { NODE_TEST_CONTEXT: _, ...env } = process.env;
    execFileSync(process.execPath, tests, { cwd: folder, stdio: "inherit", env });
  }),
);
