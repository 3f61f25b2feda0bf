// Functions of three.js that pages never call although code mentions them: by names that other functions have, too, or
// where a condition is false on every page. Each throws its name instead, so that a page which needs one does not do
// without it in silence. The list is no analysis: the browser tests find what is wrong in it.

import { childrenOf, parse, type Node } from "./syntax.ts";

/** By the module of three.js. */
type Functions = Readonly<Record<string, readonly string[]>>;

const uncalled: Functions = {
  "cameras/OrthographicCamera.js": ["copy"],
  "core/BufferAttribute.js": ["clone", "copy"],
  "core/BufferGeometry.js": [
    "addGroup",
    "applyMatrix4",
    "applyQuaternion",
    "center",
    "clone",
    "computeBoundingBox",
    "copy",
    "lookAt",
    "scale",
    "setFromPoints",
    "translate",
  ],
  "core/InstancedBufferAttribute.js": ["copy"],
  "core/InstancedBufferGeometry.js": ["copy"],
  "core/InstancedInterleavedBuffer.js": ["clone", "copy"],
  "core/InterleavedBuffer.js": ["clone", "copy"],
  "core/InterleavedBufferAttribute.js": ["clone"],
  "core/RenderTarget.js": ["clone", "copy"],
  "lights/DirectionalLight.js": ["copy"],
  "lights/Light.js": ["copy"],
  "lights/PointLight.js": ["copy"],
  "lights/SpotLight.js": ["copy"],
  "materials/LineBasicMaterial.js": ["copy"],
  "materials/Material.js": ["clone", "copy"],
  "materials/MeshBasicMaterial.js": ["copy"],
  "materials/MeshPhongMaterial.js": ["copy"],
  "materials/PointsMaterial.js": ["copy"],
  "materials/ShaderMaterial.js": ["copy"],
  "math/Box2.js": ["distanceToPoint", "intersectsBox", "setFromCenterAndSize", "setFromPoints"],
  "math/Box3.js": ["distanceToPoint", "intersectsBox", "intersectsSphere"], // of frustums they are called
  "math/Color.js": ["setHSL", "setStyle"], // our colors are numbers
  "math/Euler.js": ["reorder", "setFromQuaternion", "setFromRotationMatrix"],
  "math/Plane.js": ["intersectsBox", "intersectsSphere"],
  "math/Ray.js": ["closestPointToPoint", "distanceToPoint", "intersectsBox", "intersectsSphere"],
  "math/Sphere.js": ["distanceToPoint", "intersectsBox", "intersectsSphere"],
  "math/Triangle.js": ["intersectsBox"],
  "objects/Line.js": ["copy"],
  "objects/Mesh.js": ["copy"],
  "objects/Points.js": ["copy"],
  "renderers/WebGLRenderer.js": ["renderTransmissionPass", "setAnimationLoop", "setEffects"],
  "renderers/webgl/WebGLClipping.js": ["beginShadows", "endShadows", "projectPlanes", "setGlobalState", "setState"],
  "renderers/webgl/WebGLGeometries.js": ["getWireframeAttribute"],
  "renderers/webgl/WebGLRenderLists.js": ["unshift"],
  "renderers/webgl/WebGLTextures.js": ["setTexture2DArray", "setTexture3D", "setupDepthTexture", "uploadCubeTexture"],
  "scenes/Scene.js": ["copy"],
};

/**
 * Functions that are called and have no effect: pages rotate objects by quaternions, not by Euler angles, and have no
 * morph targets and no background of three.js.
 */
const withoutEffect: Functions = {
  "core/Object3D.js": ["onQuaternionChange", "onRotationChange"],
  "objects/Line.js": ["updateMorphTargets"],
  "objects/Mesh.js": ["updateMorphTargets"],
  "objects/Points.js": ["updateMorphTargets"],
  "renderers/webgl/WebGLBackground.js": ["addToRenderList"],
};

/** A module of three.js, with this path in its sources, without the functions that pages never call. */
export function withoutUnusedFunctions(path: string, module: string): string {
  let text = module;
  for (const name of uncalled[path] ?? []) text = withBody(text, name, `{ throw Error("${name}"); }`, path);
  for (const name of withoutEffect[path] ?? []) text = withBody(text, name, "{}", path);
  return text;
}

/** Replaces the body of the only function or method with this name. */
function withBody(module: string, name: string, body: string, path: string): string {
  const functions = Array.from(functionsIn(parse(module), name));
  const [only] = functions;
  if (only === undefined || functions.length > 1)
    throw new Error(`three.js' ${path} has ${functions.length} functions ${name}`);
  return module.slice(0, only.start) + body + module.slice(only.end);
}

/** The bodies of the functions and methods with a name. */
function* functionsIn(node: Node, name: string): Iterable<Node> {
  const named = nameOf(node) === name ? functionOf(node) : undefined;
  if (named?.type === "FunctionDeclaration" || named?.type === "FunctionExpression") yield named.body as Node;
  else for (const child of childrenOf(node)) yield* functionsIn(child, name);
}

function nameOf(node: Node): unknown {
  if (node.type === "AssignmentExpression") return ((node.left as Node).property as Node | undefined)?.name;
  return ((node.key ?? node.id) as Node | null | undefined)?.name;
}

function functionOf(node: Node): Node | undefined {
  if (node.type === "AssignmentExpression") return node.right as Node;
  return node.type === "MethodDefinition" ? (node.value as Node) : node;
}
