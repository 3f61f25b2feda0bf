// A slider that shows and sets the time of a sequence, a button that stops its clock, and one that shows a moment.

const x3d = document.querySelector("x3d");
const clock = document.querySelector("timesensor");
const slider = document.querySelector(".scrub");
const play = document.querySelector(".play");

function setPlaying(isPlaying) {
  x3d.removeAttribute("sequence-time");
  clock.setAttribute("enabled", String(isPlaying));
  play.textContent = isPlaying ? "Stop" : "Play";
}

clock.addEventListener("outputchange", ({ fieldName, value }) => {
  if (fieldName === "fraction_changed") slider.value = String(value);
});
slider.addEventListener("input", () => {
  setPlaying(false);
  clock.setAttribute("set_fraction", slider.value);
});
play.addEventListener("click", () => setPlaying(clock.getAttribute("enabled") === "false"));

// Whatever the clock does: all sequences of the page are at this time.
document.querySelector(".second").addEventListener("click", () => {
  setPlaying(false);
  x3d.setAttribute("sequence-time", "1");
  slider.value = String(1 / Number(clock.getAttribute("cycleInterval")));
});
