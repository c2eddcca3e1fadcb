// The program, whose files are the measure of all others.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const ROOT = join(import.meta.dirname, "../..");

/** A folder for the time of a call. */
export function inFolder(use) {
  const folder = mkdtempSync(join(tmpdir(), "hexdel-web-"));
  const remove = () => rmSync(folder, { recursive: true, force: true });
  try {
    const done = use(folder);
    if (done instanceof Promise) {
      return done.finally(remove);
    }
    remove();
    return done;
  } catch (error) {
    remove();
    throw error;
  }
}

/** The files that the program makes of an input, by extension. */
export function native(input, extensions, ...options) {
  const program = process.env.HEXDEL;
  if (!program) {
    throw new Error("HEXDEL does not say where the program is: run `cargo xtask web --test`");
  }
  return inFolder((folder) => {
    const outputs = extensions.filter((e) => e !== "node").flatMap((e) => ["-o", join(folder, `mesh.${e}`)]);
    execFileSync(program, ["mesh", "--quiet", join(ROOT, "fixtures", input), ...outputs, ...options]);
    return new Map(extensions.map((e) => [e, readFileSync(join(folder, `mesh.${e}`))]));
  });
}
