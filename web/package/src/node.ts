// The package in Node, where the module is loaded at once.

import { readFileSync } from "node:fs";
import { initSync } from "../wasm/hexdel_web.js";

export * from "./api.js";

initSync({ module: readFileSync(new URL("../wasm/hexdel_web_bg.wasm", import.meta.url)) });

/** Does nothing: for code that runs in browsers, too. */
export async function init(): Promise<void> {}
