// Makes the page of a terrain: coloured by height, with a slider that exaggerates the heights.

/** Colours from the lowest to the highest point. */
const colors = "0.27 0.42 0.27, 0.45 0.55 0.32, 0.66 0.61 0.42, 0.56 0.43 0.33, 0.85 0.83 0.8";

/**
 * Turns `page`, the index.html of an elevation model converted with `--keep-attributes height` and an `--exaggerate`,
 * into the terrain's page. `range` are the heights between which the colours lie, in metres.
 */
export function terrainPage(page: string, title: string, text: string, range: readonly [number, number]): string {
  return page
    .replace(/<title>[^<]*<\/title>/, `<title>${title}</title>`)
    .replace(/(<link rel="stylesheet"[^>]*>)/, `$1\n    <link rel="stylesheet" href="terrain.css">`)
    .replace(/<Shape(?= )/i, `<Shape colorBy="height" colorMap="${colors}" colorRange="${range.join(" ")}"`)
    .replace(/<X3D([^>]*)>/i, `<X3D$1 alt="${title}">`)
    .replace(
      /<\/X3D>/i,
      `$&
    <form class="panel">
      <h1>${title}</h1>
      <p>${text}</p>
      <label>Heights <output>×2</output><input type="range" min="0.5" max="6" step="0.5" value="2"></label>
    </form>
    <script type="module" src="terrain.js"></script>`,
    );
}
