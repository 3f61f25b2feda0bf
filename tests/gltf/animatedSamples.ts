// Files with animations, below the folder of models of the Debian package assimp-testmodels.
export const animatedSamples = [
  "glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf",
  "glTF2/simple_skin/simple_skin.gltf",
  "Collada/box_nested_animation.dae",
  "FBX/huesitos.fbx",
  "X/Testwuson.X",
];
