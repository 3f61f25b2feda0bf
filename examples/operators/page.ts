// Makes the page of image operators on geometry: a form with a slider for each operator of the paper's section 7.4.

/** The Shape of a page that `imgeo convert` has made of one mesh. */
function shapeIn(page: string): string {
  const shape = /<Shape[\s\S]*?<\/Shape>/i.exec(page)?.[0];
  if (shape === undefined) throw new Error("the page has no Shape");
  return shape;
}

const slider = (name: string, about: string, min: number, max: number, step: number, value: number) =>
  `<label title="${about}">${name} <output>${value}</output>
          <input name="${name}" type="range" min="${min}" max="${max}" step="${step}" value="${value}"></label>`;

const form = (title: string) => `
    <form class="panel">
      <h1>${title}</h1>
      <p>Image operators, applied to the images that hold the coordinates of a statue.</p>
      <code class="list"></code>
      <fieldset class="vertices"><legend>Its vertices are</legend>
        <label><input type="radio" name="vertices" value="sequence" checked> in the order of its triangles</label>
        <label><input type="radio" name="vertices" value="grid"> a grid: a geometry image</label>
      </fieldset>
      <div class="sliders">
        ${slider("blur", "mean of the texels around", 0, 4, 0.25, 0)}
        ${slider("brightness", "added to y", -0.5, 0.5, 0.01, 0)}
        ${slider("contrast", "factor of x, around the middle", -1.5, 1.5, 0.05, 1)}
        ${slider("gamma", "exponent", 0.3, 3, 0.05, 1)}
        ${slider("solarize", "what lies beyond is folded back", 0.3, 1, 0.01, 1)}
        ${slider("threshold", "what lies beyond is flattened", 0.1, 1, 0.01, 1)}
        ${slider("posterise", "steps", 2, 64, 1, 64)}
      </div>
      <fieldset class="axes"><legend>negative</legend>
        ${["x", "y", "z"].map((axis) => `<label><input type="checkbox" name="negative" value="${axis}"> ${axis}</label>`).join("\n        ")}
      </fieldset>
      <label class="swizzle">swizzle <select name="swizzle">${["xyz", "yxz", "zyx", "xzy", "yzx", "zxy"]
        .map((order) => `<option>${order}</option>`)
        .join("")}</select></label>
      <p class="note" hidden></p>
      <button type="reset">Reset</button>
    </form>
    <script type="module" src="operators.js"></script>`;

/**
 * `page`: the index.html of a mesh converted with `--profile classic`. `gridPage`: that of the same mesh converted with
 * `--as geometry-image`, whose geometry files are beside those of the first.
 */
export function operatorsPage(page: string, gridPage: string, title: string): string {
  const grid = shapeIn(gridPage)
    .replace(/<Shape(?= )/i, `<Shape visible="false"`)
    .replace(/DEF="[^"]*"/gi, ""); // those of the first shape
  return page
    .replace(/<title>[^<]*<\/title>/, `<title>${title}</title>`)
    .replace(/<link rel="preload"[^>]*>\s*/g, "")
    .replace(/(<link rel="stylesheet"[^>]*>)/, `$1\n    <link rel="stylesheet" href="operators.css">`)
    .replace(/<\/Shape>/i, (end) => `${end}\n${grid}`)
    .replace(/<X3D([^>]*)>/i, `<X3D$1 alt="${title}">`)
    .replace(/<\/X3D>/i, (end) => `${end}${form(title)}`);
}
