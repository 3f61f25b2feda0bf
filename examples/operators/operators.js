// The form changes the field `operators` of both geometries: the document is live, so the view follows in the next
// frame, without a request.
const form = document.querySelector(".panel");
const [sequence, grid] = document.querySelectorAll("shape");
const note = document.querySelector(".note");

/** Sliders at these values change nothing. */
const neutral = {
  blur: "0",
  brightness: "0",
  contrast: "1",
  gamma: "1",
  solarize: "1",
  threshold: "1",
  posterise: "64",
};

const notes = {
  sequence:
    "The image has the vertices in the order of the triangles. Its neighbours are not neighbours on the surface, so the " +
    "blur draws distant vertices together and destroys the shape, as the paper notes in section 7.4. Choose the grid.",
  grid:
    "The texels of a geometry image are neighbours on the surface: the blur smooths it. Borders of its charts are " +
    "blurred along themselves; where the charts of a seam have other numbers of texels along it, it opens.",
};

function operatorsOf(values) {
  const list = Object.keys(neutral).flatMap((name) => {
    const value = values.get(name);
    if (value === neutral[name]) return [];
    if (name === "brightness") return [`brightness(0 ${value} 0)`];
    if (name === "contrast") return [`contrast(${value} 1 1)`];
    return [`${name}(${value})`];
  });
  const axes = values.getAll("negative").join("");
  if (axes !== "") list.push(`negative(${axes})`);
  if (values.get("swizzle") !== "xyz") list.push(`swizzle(${values.get("swizzle")})`);
  return list.join(" ");
}

function show() {
  const values = new FormData(form);
  const operators = operatorsOf(values);
  for (const geometry of document.querySelectorAll("imagegeometry")) geometry.setAttribute("operators", operators);
  const shown = values.get("vertices");
  sequence.setAttribute("visible", String(shown === "sequence"));
  grid.setAttribute("visible", String(shown === "grid"));
  for (const slider of form.querySelectorAll("input[type=range]"))
    slider.parentElement.querySelector("output").textContent = slider.value;
  form.querySelector(".list").textContent = operators === "" ? 'operators=""' : `operators="${operators}"`;
  note.hidden = values.get("blur") === neutral.blur;
  note.textContent = notes[shown];
}

form.addEventListener("input", show);
form.addEventListener("reset", () => setTimeout(show));
show();
