// The package in browsers.

import start from "../wasm/hexdel_web.js";

export * from "./api.js";

/**
 * Loads the module; everything else may be called when that is done. Bundlers that do not
 * follow `import.meta.url` need to be told where `hexdel/hexdel.wasm` is served.
 */
export async function init(source?: URL | string | Response | BufferSource | WebAssembly.Module): Promise<void> {
  const url = source ?? new URL("../wasm/hexdel_web_bg.wasm", import.meta.url);
  await start({ module_or_path: url });
}
