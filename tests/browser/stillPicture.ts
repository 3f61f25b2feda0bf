// The picture of a page at rest.

/** The picture when it has been the same three times in a row, or after 20 s. */
export async function stillPicture(takePicture: () => Promise<Buffer>): Promise<Buffer> {
  let last: Buffer = Buffer.alloc(0);
  let same = 0;
  for (const end = Date.now() + 20_000; same < 3 && Date.now() < end;) {
    await new Promise((resolve) => setTimeout(resolve, 150));
    const next = await takePicture();
    same = next.equals(last) ? same + 1 : 0;
    last = next;
  }
  return last;
}
