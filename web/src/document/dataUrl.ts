// Encodes bytes as a data: URL, so that generated data is delivered like files.

export function dataUrl(type: string, bytes: Uint8Array): string {
  let text = "";
  for (let offset = 0; offset < bytes.length; offset += 0x8000)
    text += String.fromCharCode(...bytes.subarray(offset, offset + 0x8000));
  return `data:${type};base64,${btoa(text)}`;
}
