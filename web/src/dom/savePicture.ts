// Saves the picture of a canvas as a file, as a click on a download link does.

/** Call it in the turn of the event loop that has drawn the canvas. `onSaved` is called when the download has begun. */
export function savePicture(canvas: HTMLCanvasElement, label: string, onSaved: () => void): void {
  canvas.toBlob((blob) => {
    if (blob === null) return; // a canvas without area
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${fileNameOf(label)}.png`;
    link.click();
    onSaved();
    // The browser reads the file some time after the click.
    setTimeout(() => {
      URL.revokeObjectURL(link.href);
    }, 60_000);
  });
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
