// The slider changes the Transform's scale: the document is live, so the view follows.
const transform = document.querySelector("transform");
const [x, , z] = transform.getAttribute("scale").split(" ");
const slider = document.querySelector(".panel input");
slider.addEventListener("input", () => {
  transform.setAttribute("scale", `${x} ${slider.value} ${z}`);
  document.querySelector(".panel output").textContent = `×${slider.value}`;
});
