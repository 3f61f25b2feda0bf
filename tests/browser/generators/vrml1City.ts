// Writes a city in VRML 1.0: every node type of the format, as exporters of 1995 used them.
//   node tests/browser/generators/vrml1City.ts BLOCKS city.wrl
// A city of BLOCKS x BLOCKS blocks has about 8 shapes a block. The same number gives the same city.

import { writeFileSync } from "node:fs";
import { argv, exit, stderr } from "node:process";

const pitch = 12; // the distance of two streets

/** A generator of pseudorandom numbers from 0 to 1 (mulberry32). */
function randomFrom(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/**
 * The definitions that blocks use: a tree, a lamp, and the corners of a house, all of them in a Switch that hides them.
 */
const library = `Switch { whichChild -1
  DEF Tree Separator {
    Transform { translation 0 .75 0 }
    Material { diffuseColor .4 .26 .13 }
    Cylinder { radius .18 height 1.5 parts SIDES }
    Translation { translation 0 2 0 }
    Material { diffuseColor [ .1 .45 .15, .05 .25 .1 ] }
    MaterialBinding { value PER_PART }
    Cone { bottomRadius 1 height 2.8 parts (SIDES | BOTTOM) }
  }
  DEF Lamp Separator {
    Coordinate3 { point [ 0 0 0, 0 3 0, .5 3.3 0 ] }
    Material { diffuseColor .2 .2 .25 }
    IndexedLineSet { coordIndex [ 0, 1, 2, -1 ] }
    Transform { translation .5 3.2 0 scaleFactor .2 .12 .2 }
    Material { emissiveColor 1 .9 .6 }
    Sphere { }
  }
}
`;

/** A house of width, height and depth whose walls, gables and roof have materials of their own. */
function house(width: number, height: number, depth: number): string {
  const [w, d, top] = [width / 2, depth / 2, height + width / 3];
  return `Coordinate3 { point [
      ${-w} 0 ${d}, ${w} 0 ${d}, ${w} 0 ${-d}, ${-w} 0 ${-d},
      ${-w} ${height} ${d}, ${w} ${height} ${d}, ${w} ${height} ${-d}, ${-w} ${height} ${-d},
      0 ${top} ${d}, 0 ${top} ${-d} ] }
    MaterialBinding { value PER_FACE_INDEXED }
    IndexedFaceSet {
      coordIndex [ 0, 1, 5, 8, 4, -1, 1, 2, 6, 5, -1, 2, 3, 7, 9, 6, -1, 3, 0, 4, 7, -1, 5, 6, 9, 8, -1, 7, 4, 8, 9, -1 ]
      materialIndex [ 0, 0, 0, 0, 1, 1 ]
    }`;
}

const round = (value: number): number => Math.round(value * 100) / 100;

function block(column: number, row: number, random: () => number): string {
  const between = (low: number, high: number): number => round(low + (high - low) * random());
  const [x, z] = [column * pitch, row * pitch];
  const color = `${between(0.5, 0.95)} ${between(0.4, 0.8)} ${between(0.3, 0.6)}`;
  const half = between(5, 14);
  const building =
    random() < 0.4
      ? `LOD { range [ 150 ] center 0 8 0
    Separator {
      Material { diffuseColor [ .55 .65 .75, .35 .4 .45 ] specularColor .6 .6 .6 shininess .6 }
      Translation { translation 0 ${half} 0 }
      DEF Tower Cube { width 5 height ${round(2 * half)} depth 5 }
    }
    Separator { Material { diffuseColor .5 .6 .7 } Translation { translation 0 8 0 } Cube { width 5 height 16 depth 5 } }
  }`
      : `Material { diffuseColor [ ${color}, .5 .15 .1 ] }
  Rotation { rotation 0 1 0 ${between(-0.1, 0.1)} }
  ${house(between(4, 7), between(3, 6), between(4, 7))}`;
  return `DEF Block_${column}_${row} Separator {
  Translation { translation ${x} 0 ${z} }
  TransformSeparator { Translation { translation -4.5 0 4.5 } USE Tree }
  TransformSeparator { MatrixTransform { matrix 1 0 0 0  .1 1.3 0 0  0 0 1 0  4.5 0 -4.5 1 } USE Tree }
  TransformSeparator { Translation { translation 4.8 0 4.8 } Rotation { rotation 0 1 0 ${between(0, 6)} } USE Lamp }
  ${building}
}
`;
}

function ground(size: number): string {
  return `Separator {
  Texture2 { image 4 4 3
    0x8a8a86 0x8a8a86 0x8a8a86 0x6a6a66 0x8a8a86 0x92928e 0x8a8a86 0x6a6a66
    0x8a8a86 0x8a8a86 0x868682 0x6a6a66 0x6a6a66 0x6a6a66 0x6a6a66 0x60605c }
  Texture2Transform { scaleFactor ${size * 2} ${size * 2} }
  TextureCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1 ] }
  Normal { vector 0 1 0 }
  NormalBinding { value OVERALL }
  Coordinate3 { point [ -9 0 ${size * pitch}, ${size * pitch} 0 ${size * pitch}, ${size * pitch} 0 -9, -9 0 -9 ] }
  ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType UNKNOWN_SHAPE_TYPE faceType CONVEX }
  IndexedFaceSet { coordIndex [ 0 1 2 3 ] }
}
`;
}

function stars(random: () => number, size: number): string {
  const points = Array.from(
    { length: 60 },
    () => `${round(size * pitch * random())} ${round(45 + 20 * random())} ${round(size * pitch * random())}`,
  );
  return `Separator {
  Coordinate3 { point [ ${points.join(", ")} ] }
  Material { emissiveColor [ 1 1 1, 1 .8 .6, .7 .8 1 ] }
  MaterialBinding { value PER_VERTEX }
  PointSet { }
}
`;
}

export function vrml1City(size: number): string {
  const random = randomFrom(1995);
  const middle = (size * pitch) / 2;
  let text = `#VRML V1.0 ascii
# A city of ${size} x ${size} blocks
Separator {
DEF Title Info { string "City in VRML 1.0" }
DEF BackgroundColor Info { string ".45 .55 .75" }
DEF Viewer Info { string "examiner" }
DEF Cameras Switch { whichChild 0
  DEF Street PerspectiveCamera { position ${middle} 22 ${size * pitch + 40} orientation 1 0 0 -.15 focalDistance 60 heightAngle .7 }
  DEF Plan OrthographicCamera { position ${middle} 80 ${middle} orientation 1 0 0 -1.5707963 height ${size * pitch + 20} }
}
DirectionalLight { direction -1 -2 -1.5 intensity .9 }
DirectionalLight { direction 1 -.6 -.4 color .6 .7 1 intensity .4 }
ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID faceType UNKNOWN_FACE_TYPE creaseAngle .6 }
${library}${ground(size)}`;
  for (let row = 0; row < size; ++row) for (let column = 0; column < size; ++column) text += block(column, row, random);
  text += `WWWAnchor { name "http://www.example.org/" description "About the city"
  Translation { translation ${middle} 32 0 }
  FontStyle { size 6 family SANS style BOLD }
  Material { diffuseColor .9 .2 .1 }
  AsciiText { string [ "City", "VRML 1.0" ] justification CENTER }
}
${stars(random, size)}}
`;
  return text;
}

if (import.meta.main) {
  const [size, path] = [Number(argv[2]), argv[3]];
  if (!(size >= 1 && size <= 200) || path === undefined) {
    stderr.write("usage: vrml1City.ts BLOCKS city.wrl\n");
    exit(1);
  }
  writeFileSync(path, vrml1City(size));
}
