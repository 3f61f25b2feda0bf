// Decodes base meshes on the page's thread, for the preview.

import { Base } from "./baseBuffers.ts";
import { payloadOf } from "./payload.ts";
import { decodeWithTypeScript } from "./typescriptDecoder.ts";

/** Decodes all base meshes of a file, whole. Rejects with DecodeError. Safe for untrusted bytes. */
export async function decodeBases(png: Uint8Array<ArrayBuffer>): Promise<Base[]> {
  return decodeWithTypeScript(await payloadOf(png)).map((patch) => new Base(patch));
}
