// A world as an author of X3D writes it: prototypes with fields, one of them from a library of another file, fog,
// sky and ground, several viewpoints, USE.

/** A shape at a position. */
const part = (position: string, material: string, geometry: string): string =>
  `<Transform translation="${position}"><Shape><Appearance>${material}</Appearance>${geometry}</Shape></Transform>`;

/** A material with a field that a field of the prototype replaces. */
const connected = (field: string, protoField: string, others = ""): string =>
  `<Material${others}><IS><connect nodeField="${field}" protoField="${protoField}"/></IS></Material>`;

/** A document of its own, whose prototype the world names by EXTERNPROTO. */
export const worldLibrary = `<?xml version="1.0" encoding="UTF-8"?>
<X3D profile="Immersive" version="4.0">
  <Scene>
    <ProtoDeclare name="Lantern">
      <ProtoInterface>
        <field name="glow" type="SFColor" accessType="inputOutput" value="1 0.8 0.4"/>
        <field name="position" type="SFVec3f" accessType="inputOutput" value="0 0 0"/>
      </ProtoInterface>
      <ProtoBody>
        <Transform>
          <IS><connect nodeField="translation" protoField="position"/></IS>
          ${part("0 1.6 0", '<Material diffuseColor="0.1 0.1 0.12"/>', '<Cylinder radius="0.06" height="3.2"/>')}
          ${part("0 3.35 0", connected("emissiveColor", "glow", ' diffuseColor="0 0 0"'), '<Sphere radius="0.22"/>')}
        </Transform>
      </ProtoBody>
    </ProtoDeclare>
  </Scene>
</X3D>
`;

const prototypes = `
    <ProtoDeclare name="Tree">
      <ProtoInterface>
        <field name="position" type="SFVec3f" accessType="inputOutput" value="0 0 0"/>
        <field name="size" type="SFVec3f" accessType="inputOutput" value="1 1 1"/>
        <field name="leaves" type="SFColor" accessType="inputOutput" value="0.15 0.4 0.15"/>
      </ProtoInterface>
      <ProtoBody>
        <Transform>
          <IS>
            <connect nodeField="translation" protoField="position"/>
            <connect nodeField="scale" protoField="size"/>
          </IS>
          ${part("0 1 0", '<Material diffuseColor="0.35 0.24 0.15"/>', '<Cylinder radius="0.2" height="2"/>')}
          ${part("0 3.4 0", connected("diffuseColor", "leaves"), '<Cone bottomRadius="1.4" height="3.4"/>')}
        </Transform>
      </ProtoBody>
    </ProtoDeclare>
    <ProtoDeclare name="House">
      <ProtoInterface>
        <field name="position" type="SFVec3f" accessType="inputOutput" value="0 0 0"/>
        <field name="turn" type="SFRotation" accessType="inputOutput" value="0 1 0 0"/>
        <field name="walls" type="SFColor" accessType="inputOutput" value="0.85 0.8 0.7"/>
        <field name="yard" type="MFNode" accessType="inputOutput"/>
      </ProtoInterface>
      <ProtoBody>
        <Transform>
          <IS>
            <connect nodeField="translation" protoField="position"/>
            <connect nodeField="rotation" protoField="turn"/>
          </IS>
          ${part("0 1.5 0", connected("diffuseColor", "walls"), '<Box size="6 3 5"/>')}
          <Shape>
            <Appearance><Material diffuseColor="0.5 0.2 0.14"/></Appearance>
            <IndexedFaceSet creaseAngle="0" coordIndex="0 1 5 4 -1 1 2 5 -1 2 3 4 5 -1 3 0 4 -1">
              <Coordinate point="-3.4 2.9 2.9, 3.4 2.9 2.9, 3.4 2.9 -2.9, -3.4 2.9 -2.9, -3.4 5 0, 3.4 5 0"/>
            </IndexedFaceSet>
          </Shape>
          ${part("0 1 2.52", '<Material diffuseColor="0.25 0.16 0.1"/>', '<Box size="1 2 0.06"/>')}
          <Group><IS><connect nodeField="children" protoField="yard"/></IS></Group>
        </Transform>
      </ProtoBody>
    </ProtoDeclare>
    <ExternProtoDeclare name="Lantern" url='"library.x3d#Lantern"'>
      <field name="glow" type="SFColor" accessType="inputOutput"/>
      <field name="position" type="SFVec3f" accessType="inputOutput"/>
    </ExternProtoDeclare>`;

const instance = (name: string, fields: Readonly<Record<string, string>>, nodes = ""): string =>
  `    <ProtoInstance name="${name}">${Object.entries(fields)
    .map(([field, value]) => `<fieldValue name="${field}" value="${value}"/>`)
    .join("")}${nodes}</ProtoInstance>`;

const bench = `<fieldValue name="yard"><Transform DEF="Bench" translation="4.4 0.4 1.5">
      <Shape><Appearance><Material diffuseColor="0.6 0.42 0.25"/></Appearance><Box size="0.5 0.12 1.8"/></Shape>
    </Transform></fieldValue>`;

/** The world's document; it names library.x3d beside it. */
export function prototypeWorld(): string {
  const instances: string[] = [];
  for (let n = 0; n < 14; ++n) {
    const z = -8 * n;
    for (const side of [-1, 1]) {
      instances.push(
        instance(
          "House",
          {
            position: `${12 * side} 0 ${z}`,
            turn: `0 1 0 ${(-side * Math.PI) / 2}`,
            walls: `${(0.6 + 0.05 * ((3 * n) % 7)).toFixed(2)} ${(0.55 + 0.04 * (n % 5)).toFixed(2)} ${(0.45 + 0.05 * ((2 * n) % 6)).toFixed(2)}`,
          },
          n % 2 === 0 ? bench : "",
        ),
        instance("Tree", {
          position: `${5 * side} 0 ${z - 4}`,
          size: `1 ${(0.9 + 0.1 * (n % 4)).toFixed(1)} 1`,
          leaves: `${(0.1 + 0.03 * (n % 4)).toFixed(2)} ${(0.34 + 0.04 * (n % 3)).toFixed(2)} 0.14`,
        }),
      );
      if (n % 2 === 0) instances.push(instance("Lantern", { position: `${3.4 * side} 0 ${z}` }));
    }
  }
  return `<?xml version="1.0" encoding="UTF-8"?>
<X3D profile="Immersive" version="4.0">
  <head><meta name="title" content="A street in the fog"/></head>
  <Scene>
    <WorldInfo title="A street in the fog"/>
    <NavigationInfo type='"WALK" "ANY"' avatarSize="0.25 1.7 0.7" headlight="false"/>
    <Background skyAngle="1.3 1.5707963" skyColor="0.36 0.46 0.62, 0.66 0.7 0.75, 0.74 0.76 0.78" groundAngle="1.5707963" groundColor="0.74 0.76 0.78, 0.74 0.76 0.78"/>
    <Fog fogType="LINEAR" color="0.74 0.76 0.78" visibilityRange="90"/>
    <DirectionalLight direction="-0.5 -0.8 -0.4" intensity="0.9" ambientIntensity="0.4" global="true"/>
    <Viewpoint description="Street" position="0 1.7 14"/>
    <Viewpoint description="Above" position="26 22 20" orientation="-0.5 0.84 0.2 0.9"/>
${prototypes}
    <Transform translation="0 -0.01 -52" rotation="1 0 0 -1.5707963">
      <Shape><Appearance><Material diffuseColor="0.4 0.44 0.34"/></Appearance><Rectangle2D size="60 150"/></Shape>
    </Transform>
    <Transform translation="0 0.01 -52" rotation="1 0 0 -1.5707963">
      <Shape><Appearance><Material diffuseColor="0.5 0.49 0.47"/></Appearance><Rectangle2D size="6 150"/></Shape>
    </Transform>
${instances.join("\n")}
  </Scene>
</X3D>
`;
}
