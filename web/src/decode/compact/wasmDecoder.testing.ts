// The WebAssembly module that `scripts/build` compiles.

import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";

const path = join(import.meta.dirname, "../../../dist/imgeo-decoder.wasm");

export function readModule(): Buffer<ArrayBuffer> {
  if (!existsSync(path)) throw new Error(`there is no ${path}: run scripts/wasm`);
  return readFileSync(path);
}

export function wasmModule(): WebAssembly.Module {
  return new WebAssembly.Module(readModule());
}
