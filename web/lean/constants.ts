// What is the same on all pages, in the sources of three.js: without multisampled targets, stencils, clipping planes,
// environments, shadows, morph targets, uniform groups, lists of materials, WebXR, and mipmaps of their own; with
// ambient and directional lights, points and spots, RGBA images that are neither compressed nor three-dimensional, and
// two kinds of blending. The list is no analysis: the browser tests find what is wrong in it.

type Constant = readonly [text: RegExp, constant: string];

/** Lines that set, or list, properties of lights whose names these are the beginnings of. */
const unusedLights = String.raw`(sun|rectArea|hemi|ltc_|light[pP]robe|probe|num|spotLightM|\w+Shadow)\w*`;

/** Properties of materials for maps that no material of ours has. */
const unusedMaps: Constant = [
  /^\t\tthis\.(lightMap|alphaMap|envMap|bump|displacement|combine|reflectivity|refraction|wireframeLine)\w* = .*$/gm,
  "",
];

/** By the module of three.js. */
const constants: Readonly<Record<string, readonly Constant[]>> = {
  "core/RenderTarget.js": [
    [/^\t\tthis\.(resolve\w+|storeMultisampled\w+|multiview|useArrayDepthTexture) = .*$/gm, ""],
    [/^\t\t\t(resolve\w+|storeMultisampled\w+|multiview|useArrayDepthTexture): .*$/gm, ""],
  ],
  "materials/Material.js": [[/^\t\tthis\.(stencil\w+|clip\w+|alphaHash|shadowSide) = .*$/gm, ""]],
  "materials/MeshBasicMaterial.js": [unusedMaps],
  "materials/MeshPhongMaterial.js": [unusedMaps],
  "math/Color.js": [[/^Color\.NAMES = _colorKeywords;$/gm, ""]],
  "math/ColorManagement.js": [
    [/this\.enabled === false \|\| /g, ""],
    [/this\.spaces\[ \w+ \]\.primaries !== this\.spaces\[ \w+ \]\.primaries/g, "false"],
  ],
  "renderers/WebGLRenderer.js": [
    [/_clippingEnabled === true/g, "false"],
    [/material\.wireframe === true/g, "false"],
    [/output !== null/g, "false"],
    [/renderTarget\.samples > 0/g, "false"],
    [/xr\.enabled === false/g, "true"],
    [/xr\.enabled === true/g, "false"],
    [/^\t+xr\.(addEventListener|removeEventListener|dispose)\(.*$/gm, ""],
    [/^\t+(const animation = |animation\.(setAnimationLoop|setContext|stop)\(|if \( typeof self !== ).*$/gm, ""],
    [/context !== null/g, "true"],
    [/_gl === null/g, "false"],
    [/_outputBufferType !== UnsignedByteType/g, "false"],
    [/INTEGER_FORMATS\.has\( targetFormat \)/g, "targetFormat === RGBAIntegerFormat"],
    [/UNSIGNED_TYPES\.has\( targetType \)/g, "true"],
    [/if \( stencil \) \{/g, "if ( false ) {"],
    [/state\.buffers\.depth\.getReversed\(\)/g, "false"],
    [/capabilities\.(reversedDepthBuffer|logarithmicDepthBuffer)/g, "false"],
    [/Array\.isArray\( (material|__webglFramebuffer(\[ activeCubeFace \])?) \)/g, "false"],
    [/group !== null/g, "false"],
    [/transmissiveObjects\.length > 0/g, "false"],
    [/\( material\.isMeshStandardMaterial \|\| .*? \) \? scene\.environment : null/g, "null"],
    [/environments\.get\( .* \)/g, "null"],
    [/^\t\t\tmaterialProperties\.(environment|envMap|envMapRotation) = .*$/gm, ""],
    [/^\t\t\tconst (usePMREM|vertexTangents) = .*$/gm, ""],
    [/materialProperties\.envMap !== envMap/g, "false"],
    [/typeof WebGLRenderingContext !== 'undefined' && context instanceof WebGLRenderingContext/g, "false"],
    [/camera !== undefined && camera\.isCamera !== true/g, "false"],
    [/scene\.environment !== null|m_uniforms\.dfgLUT !== undefined|material\.uniformsGroups !== undefined/g, "false"],
    [/!! geometry\.morphAttributes\.\w+|morphAttributes\.\w+ !== undefined/g, "false"],
    [/geometry\.morphAttributes\.\w+ \|\| .*;/g, "undefined;"],
    [/^\t\t\tmaterialProperties\.(batching|instancing|skinning|morph|num|vertexTangents)\w* = .*$/gm, ""],
    [/materialProperties\.(batching|instancing|skinning) === true/g, "false"],
    [/materialProperties\.(morph\w+|vertexTangents) !== \w+/g, "false"],
    [/materialProperties\.numClippingPlanes !== undefined/g, "false"],
    [/materialProperties\.numLightProbeGrids (!== countLightProbeGrids\( .*? \)|> 0)/g, "false"],
    [/lights\.state\.\w+ShadowMap\.length > 0/g, "false"],
    [new RegExp(String.raw`^\t+uniforms\.${unusedLights}\.(value|needsUpdate) = .*$`, "gm"), ""],
  ],
  "renderers/shaders/UniformsLib.js": [
    [new RegExp(String.raw`^\t\t${unusedLights}: \{ value: \[\], properties: \{$.*?^\t\t\} \},?$`, "gms"), ""],
    [new RegExp(String.raw`^\t\t${unusedLights}: .*$`, "gm"), ""],
    [/^\t(envmap|lightmap|bumpmap|displacementmap|metalnessmap|roughnessmap): \{$.*?^\t\},?$/gms, ""],
    [/^\t(gradientmap|points|sprite): \{$.*?^\t\},?$/gms, ""],
  ],
  "renderers/webgl/WebGLBackground.js": [
    [/background && background\.isTexture|(box|plane)Mesh !== undefined/g, "false"],
    [/environmentBlendMode === '[\w-]+'/g, "false"],
    [/^\t\tconst environmentBlendMode = .*$/gm, ""],
  ],
  "renderers/webgl/WebGLBindingStates.js": [[/^\t+if \( name === 'instance(Matrix|Color)' .*$/gm, ""]],
  "renderers/webgl/WebGLCapabilities.js": [
    [/parameters\.(reversedDepthBuffer|logarithmicDepthBuffer) === true/g, "false"],
    [/^\tconst (maxAttributes|maxVertexUniforms|maxVaryings|maxFragmentUniforms|maxSamples|samples) = .*$/gm, ""],
    [/^\t\t(maxAttributes|maxVertexUniforms|maxVaryings|maxFragmentUniforms|maxSamples|samples): .*$/gm, ""],
    [/^\t\t(isWebGL2|textureFormatReadable|textureTypeReadable): .*$/gm, ""],
  ],
  "renderers/webgl/WebGLLights.js": [
    [/^\t\t\t\tcase 'SunLight':$/gm, ""],
    [/^\t\t\t\tcase '(HemisphereLight|RectAreaLight)':$.*?break;/gms, ""],
    [/light\.(isSunLight|map)\b|light\.shadow && light\.shadow\.map/g, "false"],
    [/^\t\tlights\.sort\( .*$/gm, ""],
    [/rectAreaLength > 0/g, "false"],
    [/hash\.(sunLength|rectAreaLength|hemiLength|num\w+) !== \w+/g, "false"],
    [/^\t+state\.spotLightMatrix\[ .*$/gm, ""],
    [/^.*state\.probe.*$/gm, ""],
    [new RegExp(String.raw`^\t+(hash|state)\.${unusedLights}(\.length)? = .*$`, "gm"), ""],
    [new RegExp(String.raw`^\t\t\t?${unusedLights}: .*$`, "gm"), ""],
  ],
  "renderers/webgl/WebGLMaterials.js": [
    [/if \( (material\.)?(envMap|alphaMap|bumpMap|displacementMap|lightMap) \)/g, "if ( false )"],
    [/^\t+const (envMap|envMapRotation) = .*$/gm, ""],
    [/material\.(isLineBasicMaterial|isPointsMaterial)/g, "false"],
  ],
  "renderers/webgl/WebGLPrograms.js": [
    [/^\t\tMesh(Depth|Distance|Normal|Lambert|Toon|Standard|Physical|Matcap)Material: .*$/gm, ""],
    [/^\t\t(LineDashed|Points|Shadow|Sprite)Material: .*$/gm, ""],
    [/material\.precision !== null/g, "false"],
    [/environments\.get\( .* \)/g, "null"],
    [/geometry\.morphAttributes\.\w+ !== undefined/g, "false"],
    [/geometry\.morphAttributes\.\w+ \|\| .*;/g, "undefined;"],
  ],
  "renderers/webgl/WebGLRenderLists.js": [
    [
      /material\.transmission > 0\.0|camera\.reversedDepth === true|a\.materialVariant !== b\.materialVariant/g,
      "false",
    ],
    [/^\t\tif \( transmissive\.length > 1 \) .*$/gm, ""],
    [/^\t+(materialVariant: |renderItem\.materialVariant = ).*$/gm, ""],
  ],
  "renderers/webgl/WebGLState.js": [
    [/material\.stencilWrite;/g, "false;"],
    [/^\t+(const stencilBuffer = .*|stencilBuffer\.set(Clear|Test)\( .*|stencil: stencilBuffer)$/gm, ""],
    [/if \( currentReversed \)/g, "if ( false )"],
    [/depthBuffer\.getReversed\(\)/g, "false"],
    [/^\t\t(compressed\w+|tex\w+3D|uniformBlockBinding|updateUBOMapping|reset): \w+,?$/gm, ""],
    [/^\t\t\treset: function \(\) \{.*?^\t\t\t\}$/gms, ""],
    [/^\temptyTextures\[ gl\.TEXTURE_(2D_ARRAY|3D) \] = .*$/gm, ""],
    [/\btype === gl\.TEXTURE_3D \|\| type === gl\.TEXTURE_2D_ARRAY/g, "false"],
    [/^\t+case (Additive|Subtractive|Multiply)Blending:$.*?break;$/gms, ""],
    [/^\t+case (Never|Less|Equal|GreaterEqual|Greater|NotEqual)Depth:$.*?break;$/gms, ""],
  ],
  "renderers/webgl/WebGLTextures.js": [
    [/^\t\tif \( glFormat === _gl\.(RED|RG|RGB)(_INTEGER)? \) \{$.*?^\t\t\}$/gms, ""],
    [/^\t\t\tif \( glType === _gl\.(BYTE|SHORT|INT|UNSIGNED_SHORT(_\w+)?)( && ext_texture_norm16)? \) .*$/gm, ""],
    [/texture(Type|Target) === _gl\.TEXTURE_3D \|\| texture(Type|Target) === _gl\.TEXTURE_2D_ARRAY/g, "false"],
    [/renderTarget\.depthTexture\b/g, "null"],
    [/renderTarget\.samples > 0/g, "false"],
    [/(?<!function )useMultisampledRTT\( renderTarget \)/g, "false"],
    [/(?<=if \( )useMultisample(?= )/g, "false"],
    [/renderTarget\.stencilBuffer\b/g, "false"],
    [/getInternalDepthFormat\( .* \);/g, "_gl.DEPTH_COMPONENT24;"],
    [/\b(texture\.|renderTarget\.texture\.)?mipmaps\.length > 0/g, "false"],
    [/Array\.isArray\( renderTargetProperties\.__webglFramebuffer(\[ i \])? \)/g, "false"],
    [/if \( texture\.compareFunction \)|if \( internalFormatName !== null \)/g, "if ( false )"],
    [/^\tconst compareToGL = \{$.*?^\t\};$/gms, ""],
    [/^\t+image = verifyColorSpace\( .*$/gm, ""],
    [/if \( normalized \)/g, "if ( false )"],
    [/typeof (HTMLImageElement|HTMLCanvasElement|ImageBitmap) !== 'undefined' && /g, ""],
  ],
  "renderers/webgl/WebGLUniforms.js": [
    [/^\t\tcase 0x(8b5a|8dc6|8dc7|8dc8): .*$/gm, ""], // 2 x 2 matrices, vectors of unsigned integers
    [/^\t\tcase 0x(8b5f|8dcb|8dd3|8dc1|8dcf|8dd7|8dc4): .*$|^\t\t\treturn setValueT(3D|2DArray)\w+;$/gm, ""],
    [/return setValue(T1|T6|V[234]i|V1ui)Array;/g, "return;"],
    [/this\.type === gl\.SAMPLER_(2D|CUBE)_SHADOW/g, "false"],
  ],
  "renderers/webgl/WebGLUtils.js": [
    [/^\t\tif \( p === \w+_Format\b.*?^\t\t\}$/gms, ""],
    [/^\t\tif \( p === (Byte|Short|Int|UnsignedShort\d*|UnsignedInt\d+)Type \) .*$/gm, ""],
    [/^\t\tif \( p === (Alpha|RGB|Depth|DepthStencil|Red|RedInteger|RG|RGInteger|RGBInteger)Format \) .*$/gm, ""],
    [/^\t+const transfer = .*$/gm, ""],
  ],
};

/** A module of three.js, with this path in its sources, with what is the same on all pages. */
export function withConstants(path: string, module: string): string {
  let text = module;
  for (const [pattern, constant] of constants[path] ?? []) {
    if (text.search(pattern) < 0) throw new Error(`three.js' ${path} has no ${pattern.source} any more`);
    text = text.replaceAll(pattern, constant);
  }
  return text;
}
