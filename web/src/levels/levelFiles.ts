// The files of a mesh with levels: their urls, and the payloads of the index's pages (docs/formats/levels.md, "Index").

import { payloadOf } from "../decode/compact/payload.ts";
import { DecodeError } from "../decode/decodeError.ts";
import { LevelIndex } from "./levelIndex.ts";

/** The url of a group's file: "0/7.png" beside the index. What follows ? in the url of the index is kept. */
export function groupUrl(indexUrl: string, group: number): string {
  const { path, query } = partsOf(indexUrl);
  return `${path.slice(0, path.lastIndexOf("/") + 1)}${Math.floor(group / 1000)}/${group % 1000}.png${query}`;
}

/** The url of a group's image: "0/7.webp" beside the index. */
export function chipUrl(indexUrl: string, group: number): string {
  return groupUrl(indexUrl, group).replace(/\.png(?=[?#]|$)/, ".webp");
}

/** The url of a page: "levels.png" for page 0 of "levels.png", and "levels-2.png" for page 2. */
export function levelPageUrl(indexUrl: string, page: number): string {
  if (page === 0) return indexUrl;
  const { path, query } = partsOf(indexUrl);
  const dot = path.lastIndexOf(".");
  const end = dot > path.lastIndexOf("/") ? dot : path.length;
  return `${path.slice(0, end)}-${page}${path.slice(end)}${query}`;
}

function partsOf(url: string): { path: string; query: string } {
  const end = url.search(/[?#]/);
  return end < 0 ? { path: url, query: "" } : { path: url.slice(0, end), query: url.slice(end) };
}

/** Reads the file of page 0. Safe for untrusted bytes. Rejects with DecodeError. */
export async function readLevelIndex(file: Uint8Array<ArrayBuffer>): Promise<LevelIndex> {
  return new LevelIndex(await payloadOf(file));
}

/** Adds the file of a further page to its index. Rejects with DecodeError, and leaves the index unchanged. */
export async function addPageFile(index: LevelIndex, page: number, file: Uint8Array<ArrayBuffer>): Promise<void> {
  if (file.length !== index.pageBytes[page])
    throw new DecodeError("malformed", "has another size than the index of levels states");
  index.addPage(page, await payloadOf(file));
}
