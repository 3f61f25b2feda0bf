// Fields of nodes that are drawn, whose type the runtime's own table does not tell, since it reads lists of vectors as
// lists of numbers, or does not have as fields, since they are events.

const lists: Readonly<Record<string, string>> = {
  "coordinate.point": "MFVec3f",
  "coordinatedouble.point": "MFVec3d",
  "normal.vector": "MFVec3f",
  "color.color": "MFColor",
  "colorrgba.color": "MFColorRGBA",
  "texturecoordinate.point": "MFVec2f",
  "fogcoordinate.depth": "MFFloat",
  "elevationgrid.height": "MFFloat",
  "extrusion.spine": "MFVec3f",
  "extrusion.crosssection": "MFVec2f",
  "extrusion.scale": "MFVec2f",
  "extrusion.orientation": "MFRotation",
  "polyline2d.linesegments": "MFVec2f",
  "polypoint2d.point": "MFVec2f",
  "triangleset2d.vertices": "MFVec2f",
};

const events: Readonly<Record<string, string>> = { set_bind: "SFBool", bind: "SFBool" };

/** The name of the type of a field of a drawn node; undefined where the tables do not have it. */
export function listTypeOf(node: string, field: string): string | undefined {
  const key = `${node.toLowerCase()}.${field.toLowerCase()}`;
  return Object.hasOwn(lists, key) ? lists[key] : Object.hasOwn(events, field) ? events[field] : undefined;
}
