// Decodes files of compact with the faster decoder that is there: WebAssembly in a worker that has received its module,
// TypeScript everywhere else and until then.

import type { DecodeFile } from "./decodedFile.ts";
import { decodeWithTypeScript } from "./typescriptDecoder.ts";
import { WasmDecoder } from "./wasmDecoder.ts";

let wasm: WasmDecoder | undefined;

/** Has `decodeFile` use the WebAssembly module from now on. */
export function useWasm(module: WebAssembly.Module): void {
  wasm = new WasmDecoder(module);
}

/**
 * Decodes all patches or base meshes of a payload. Safe for untrusted bytes. Throws DecodeError. What WebAssembly
 * refuses is decoded again: TypeScript has the words for the refusal, and may have memory where the module has none. So
 * is what a module decodes that belongs to another version of the runtime.
 */
export const decodeFile: DecodeFile = (payload) => {
  if (wasm) {
    try {
      return wasm.decode(payload);
    } catch {
      // See above.
    }
  }
  return decodeWithTypeScript(payload);
};
