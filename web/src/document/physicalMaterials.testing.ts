/** A PhysicalMaterial with all 17 textures that it and its extensions can have. */
export const allTextures = physicalMaterial({
  "": ["base", "emissive", "metallicRoughness", "normal", "occlusion"],
  Anisotropy: ["anisotropy"],
  Clearcoat: ["clearcoat", "clearcoatRoughness", "clearcoatNormal"],
  Iridescence: ["iridescence", "iridescenceThickness"],
  Sheen: ["sheenColor", "sheenRoughness"],
  Specular: ["specular", "specularColor"],
  Transmission: ["transmission"],
  Volume: ["thickness"],
});

function physicalMaterial({ "": own = [], ...extensions }: Record<string, readonly string[]>): string {
  const textures = (fields: readonly string[]) =>
    fields.map((field) => `<ImageTexture containerField="${field}Texture" url="texel.png"></ImageTexture>`).join("");
  const children = Object.entries(extensions).map(
    ([name, fields]) => `<${name}MaterialExtension>${textures(fields)}</${name}MaterialExtension>`,
  );
  return `<PhysicalMaterial>${textures(own)}${children.join("")}</PhysicalMaterial>`;
}
