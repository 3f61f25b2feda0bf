// When the next frame is due, also in pages that draw none.

/** In a page that nobody sees there are no frames, but files come. */
const framelessMs = 250;

/** Calls back before the next frame; later, and with `true`, in a page that nobody sees. */
export function beforeNextFrame(callback: (isUnseen: boolean) => void): void {
  const call = (isUnseen: boolean) => {
    cancelAnimationFrame(frame);
    clearTimeout(timer);
    callback(isUnseen);
  };
  const frame = requestAnimationFrame(() => {
    call(false);
  });
  const timer = setTimeout(() => {
    call(document.hidden);
  }, framelessMs);
}
