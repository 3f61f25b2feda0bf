// The checkbox of a scene pauses it: all clocks stand, and go on where they were.

for (const box of document.querySelectorAll(".pause")) {
  const viewer = box.closest("figure").querySelector("imgeo-viewer");
  const follow = () => {
    if (box.checked) viewer.setAttribute("paused", "");
    else viewer.setAttribute("paused", "false"); // also for users who prefer reduced motion: they have chosen to play
  };
  box.checked = matchMedia("(prefers-reduced-motion: reduce)").matches;
  follow();
  box.addEventListener("change", follow);
}
