// Replaces the containers of a page by the source's numbers in X3DOM's plain nodes, for reference pictures.

import type { PlainMesh } from "../browser/meshes.ts";

/** Replaces everything in the only source shape by an inline copy of `mesh`. */
export function referencePage(html: string, mesh: PlainMesh): string {
  const begin = html.search(/<(Group|Shape)\b/);
  const group = html.indexOf("</Group>", begin);
  const end = group > 0 ? group + "</Group>".length : html.indexOf("</Shape>", begin) + "</Shape>".length;
  const appearance = /<Appearance[\s\S]*?<\/Appearance>/.exec(html.slice(begin, end))?.[0];
  if (begin < 0 || appearance === undefined) throw new Error("the page has no shape with an appearance");
  const shape = `<Shape>${appearance}${plainNode(mesh)}</Shape>`;
  return html.slice(0, begin) + shape + html.slice(end);
}

function plainNode({
  positions,
  normals,
  colors,
  texCoords,
  triangles,
  lines = new Uint32Array(0),
}: PlainMesh): string {
  const coordinate = `<Coordinate point="${positions.join(" ")}"></Coordinate>`;
  const color = colors ? `<Color color="${Array.from(colors, (byte) => byte / 255).join(" ")}"></Color>` : "";
  if (lines.length > 0) {
    const index = Array.from({ length: lines.length / 2 }, (_, line) => `${lines[2 * line]} ${lines[2 * line + 1]} -1`);
    return `<IndexedLineSet coordIndex="${index.join(" ")}">${coordinate}${color}</IndexedLineSet>`;
  }
  if (triangles.length === 0) return `<PointSet>${coordinate}${color}</PointSet>`;
  if (!normals) throw new Error("a reference needs the normals that convert computes");
  // Normals of vertices without triangles are NaN, which X3DOM would skip.
  const vectors = normals.map((value) => (Number.isFinite(value) ? value : 0));
  const normal = `<Normal vector="${vectors.join(" ")}"></Normal>`;
  const texCoord = texCoords ? `<TextureCoordinate point="${texCoords.join(" ")}"></TextureCoordinate>` : "";
  return `<IndexedTriangleSet index="${triangles.join(" ")}">${coordinate}${normal}${color}${texCoord}</IndexedTriangleSet>`;
}
