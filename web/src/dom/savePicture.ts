// Saves a picture as a file, as a click on a download link does.

/** Begins the download of a picture. `label`: of the scene, which names the file. */
export function savePicture(picture: Blob, label: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(picture);
  link.download = `${fileNameOf(label)}.png`;
  link.click();
  // The browser reads the file some time after the click.
  setTimeout(() => {
    URL.revokeObjectURL(link.href);
  }, 60_000);
}

/**
 * The label in lower case with hyphens between its words, at most 60 characters: "Marble statue" to "marble-statue".
 */
export function fileNameOf(label: string): string {
  const words =
    label
      .normalize("NFC")
      .toLowerCase()
      .match(/[\p{L}\p{M}\p{N}]+/gu) ?? [];
  return words.join("-").slice(0, 60) || "scene";
}
