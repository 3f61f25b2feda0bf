// Callbacks before the next frame, also in hidden pages, which get no animation frames.

/** If no animation frame comes within this time, a timer calls back, since files keep arriving in hidden pages. */
const maxWaitMs = 250;

/** Calls back before the next frame, or after `maxWaitMs`. `isHidden`: whether the page is hidden. */
export function beforeNextFrame(callback: (isHidden: boolean) => void): void {
  const call = (isHidden: boolean) => {
    cancelAnimationFrame(frame);
    clearTimeout(timer);
    callback(isHidden);
  };
  const frame = requestAnimationFrame(() => {
    call(false);
  });
  const timer = setTimeout(() => {
    call(document.hidden);
  }, maxWaitMs);
}
