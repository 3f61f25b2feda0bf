// Callbacks before the next frame, also in hidden pages, which get no animation frames.

/**
 * Without an animation frame within this time, the callback comes from a timer: files keep arriving in hidden pages.
 */
const framelessMs = 250;

/** Calls back before the next frame, or after `framelessMs`. `isUnseen`: the page is hidden. */
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
