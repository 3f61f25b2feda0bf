// A node -> what it says: for itself at once, for those below it when it is known
// what is handed down to them.

import type { AnchorDescription, BackgroundDescription, GroupDescription, NodeDescription } from "./description.ts";
import type { SceneElement } from "./element.ts";
import { attributeOf, lowerNameOf } from "./element.ts";
import type { Vec3 } from "./fieldTypes.ts";
import { boxOf } from "./geometry.ts";
import type { Warning } from "./nodes.ts";
import { nodeFields, readFields } from "./nodes.ts";
import { asViewpoint } from "./orthoViewpoint.ts";
import type { ShapeReading } from "./readShape.ts";
import { readShape } from "./readShape.ts";
import type { Asides, Below, Inherited, Said, Saying } from "./said.ts";
import { asidesOf, joined, warned } from "./said.ts";

/** A document that an Inline shows. */
export interface InlinedDocument {
  readonly url: string;
  /** Its <X3D>; the urls in it are absolute. */
  readonly x3d: SceneElement;
}

/** What reading a node needs besides its element. */
export interface NodeReading extends ShapeReading {
  /** The element of the page that stands for it. */
  readonly host: SceneElement;
  readonly childrenOf: (element: SceneElement) => readonly SceneElement[];
  readonly levelOf: (lod: SceneElement) => number | undefined;
  /** The elements of the document that an Inline shows; undefined where there is none, or none that may be shown. */
  readonly inlined: (inline: SceneElement) => SceneElement | undefined;
}

/** What is below other nodes are nodes too. */
export function isReadAsWhole(node: SceneElement): boolean {
  return lowerNameOf(node) === "shape";
}

/** `element` is who says it, `node` what it is: the same but for USE. */
export function readNode(element: SceneElement, node: SceneElement, reading: NodeReading): Saying {
  const { warnings } = reading;
  switch (lowerNameOf(node)) {
    case "shape":
      return sayShape(element, node, reading);
    case "group":
    case "staticgroup":
      return sayGroup(node, readFields(node, nodeFields.Group, warnings), reading);
    case "anchor": {
      const { url, description, parameter, ...fields } = readFields(node, nodeFields.Anchor, warnings);
      const anchor: AnchorDescription = { element: node, urls: url, description, target: targetIn(parameter) };
      return sayGroup(node, fields, reading, url.length > 0 ? { anchor } : {});
    }
    case "collision":
      return sayGroup(node, readFields(node, nodeFields.Group, warnings), {
        ...reading,
        childrenOf: (of) => reading.childrenOf(of).filter(isSeenChild),
      });
    case "billboard": {
      const { axisOfRotation, ...fields } = readFields(node, nodeFields.Billboard, warnings);
      return sayGroup(node, fields, reading, { billboardAxis: axisOfRotation });
    }
    case "transform": {
      const transform = readFields(node, nodeFields.Transform, warnings);
      return sayGroup(node, transform, reading, { transform });
    }
    case "switch":
      return saySwitch(node, reading);
    case "lod":
      return sayLevels(node, reading);
    case "inline":
      return sayInline(node, reading);
    case "directionallight":
      return sayLight({ kind: "directional", ...readFields(node, nodeFields.DirectionalLight, warnings) }, warnings);
    case "pointlight":
      return sayLight({ kind: "point", ...readFields(node, nodeFields.PointLight, warnings) }, warnings);
    case "spotlight":
      return sayLight({ kind: "spot", ...readFields(node, nodeFields.SpotLight, warnings) }, warnings);
    case "viewpoint":
      return say(
        [{ kind: "viewpoint", element, viewpoint: readFields(node, nodeFields.Viewpoint, warnings) }],
        warned(warnings),
      );
    case "orthoviewpoint":
      return say(
        [{ kind: "viewpoint", element, viewpoint: asViewpoint(readFields(node, nodeFields.OrthoViewpoint, warnings)) }],
        warned(warnings),
      );
    case "navigationinfo":
      return say([], asidesOf({ navigation: readFields(node, nodeFields.NavigationInfo, warnings), warnings }));
    case "background":
      return say([], asidesOf({ background: readBackground(node, warnings), warnings }));
    default:
      return (inherited, below) => below(reading.childrenOf(node), inherited);
  }
}

/** The same whatever is handed down. */
function say(nodes: readonly NodeDescription[], asides: Asides): Saying {
  const said: Said = { nodes, asides };
  return () => said;
}

function sayLight(light: Extract<NodeDescription, { kind: "light" }>["light"], warnings: readonly Warning[]): Saying {
  return say([{ kind: "light", light }], warned(warnings));
}

function sayShape(element: SceneElement, node: SceneElement, reading: NodeReading): Saying {
  const shape = readShape(element, reading.host, node, reading);
  const asides = warned(reading.warnings);
  return ({ visible, reaches, priority }) => ({
    nodes: [
      {
        ...shape,
        visible: visible && shape.visible,
        reaches: reaches && shape.reaches,
        priority: priority * shape.priority,
      },
    ],
    asides,
  });
}

function readBackground(node: SceneElement, warnings: Warning[]): BackgroundDescription {
  const { skyColor, skyAngle, groundColor, groundAngle } = readFields(node, nodeFields.Background, warnings);
  // The first colour is at the pole, each further one at its angle.
  const rings = (colors: readonly Vec3[], angles: readonly number[]) =>
    colors.slice(0, angles.length + 1).map((color, i) => ({ color, angle: i === 0 ? 0 : (angles[i - 1] ?? 0) }));
  return {
    sky: rings(skyColor.length > 0 ? skyColor : [[0, 0, 0]], skyAngle),
    ground: rings(groundColor, groundAngle),
  };
}

interface GroupFields {
  readonly visible: boolean;
  readonly render: boolean;
  readonly priority: number;
  readonly bboxCenter: Vec3;
  readonly bboxSize: Vec3;
}

function isSeen({ visible, render }: Pick<GroupFields, "visible" | "render">): boolean {
  return visible && render;
}

/** What a node with these fields hands down. */
function within(fields: GroupFields, inherited: Inherited): Inherited {
  const seen = isSeen(fields);
  return {
    visible: inherited.visible && seen,
    reaches: inherited.reaches && seen,
    priority: inherited.priority * fields.priority,
  };
}

/** What groups of a kind have besides. */
type GroupTraits = Partial<Pick<GroupDescription, "transform" | "billboardAxis" | "anchor">>;

function groupOf(
  fields: GroupFields,
  children: readonly NodeDescription[],
  traits: GroupTraits = {},
): GroupDescription {
  return { kind: "group", visible: isSeen(fields), box: boxOf(fields), transform: undefined, ...traits, children };
}

/** An Anchor's parameters are pairs `name=value`. */
function targetIn(parameter: readonly string[]): string {
  return (
    parameter.map((pair) => /^\s*target\s*=\s*(\S+)\s*$/i.exec(pair)?.[1]).find((target) => target !== undefined) ?? ""
  );
}

/** A Collision's proxy stands in for its children where people walk, not where they look. */
function isSeenChild(child: SceneElement): boolean {
  return attributeOf(child, "containerField") !== "proxy";
}

function sayGroup(
  node: SceneElement,
  fields: GroupFields,
  { warnings, childrenOf }: NodeReading,
  traits?: GroupTraits,
): Saying {
  const own = warned(warnings);
  return (inherited, below) => {
    const { nodes, asides } = below(childrenOf(node), within(fields, inherited));
    return { nodes: [groupOf(fields, nodes, traits)], asides: joined([own, asides]) };
  };
}

/** One of its children is seen, or none; the others stay in the scene, so that choosing them shows at once what they have. */
function saySwitch(node: SceneElement, { warnings, childrenOf }: NodeReading): Saying {
  const fields = readFields(node, nodeFields.Switch, warnings);
  const own = warned(warnings);
  return (inherited, below) =>
    sayChoice(choicesIn(childrenOf(node)), fields.whichChoice, false, fields, inherited, below, own);
}

/** Children that are no nodes of their own are none of the choices. */
function choicesIn(children: readonly SceneElement[]): SceneElement[] {
  return children.filter((child) => !lowerNameOf(child).startsWith("metadata"));
}

/** `allReach`: the scene reaches as far as those that are not chosen. */
function sayChoice(
  choices: readonly SceneElement[],
  choice: number,
  allReach: boolean,
  fields: GroupFields,
  inherited: Inherited,
  below: Below,
  own: Asides,
  levels?: GroupDescription["levels"],
): Said {
  const each = choices.map((child, place) => {
    const visible = place === choice;
    const said = below(
      [child],
      within(fields, {
        ...inherited,
        visible: inherited.visible && visible,
        reaches: inherited.reaches && (visible || allReach),
      }),
    );
    const group: GroupDescription = {
      kind: "group",
      box: undefined,
      visible,
      transform: undefined,
      children: said.nodes,
    };
    return { group, asides: said.asides };
  });
  const children = each.map(({ group }) => group);
  const group: GroupDescription = {
    kind: "group",
    box: undefined,
    visible: isSeen(fields),
    transform: undefined,
    children,
  };
  return {
    nodes: [levels === undefined ? group : { ...group, levels }],
    asides: joined([own, ...each.map(({ asides }) => asides)]),
  };
}

/** A choice that the distance makes. Until it is known the last level is seen, which asks for least. */
function sayLevels(node: SceneElement, { warnings, childrenOf, levelOf }: NodeReading): Saying {
  const { center, range, ...fields } = readFields(node, nodeFields.LOD, warnings);
  const own = warned(warnings);
  return (inherited, below) => {
    const choices = choicesIn(childrenOf(node));
    const last = choices.length - 1;
    const level = Math.min(levelOf(node) ?? last, last);
    return sayChoice(choices, level, true, fields, inherited, below, own, {
      element: node,
      center,
      range,
      count: choices.length,
    });
  };
}

/** The document stands where the Inline does, with names of its own; what it says of the whole scene counts for nothing. */
function sayInline(node: SceneElement, { warnings, inlined }: NodeReading): Saying {
  const { load, url, ...fields } = readFields(node, nodeFields.Inline, warnings);
  const x3d = load ? inlined(node) : undefined;
  const own = warned(warnings);
  return (inherited, below) => {
    const inner = within(fields, inherited);
    const inlines =
      load && url.length > 0 ? [{ element: node, urls: url, visible: inner.visible, priority: inner.priority }] : [];
    const { nodes, asides } = below(x3d ? [x3d] : [], inner);
    const ofItsScene = { ...asides, navigation: undefined, background: undefined };
    return {
      nodes: [{ ...groupOf(fields, nodes), ...(inlines.length > 0 && { inline: node }) }],
      asides: joined([asidesOf({ inlines }), own, ofItsScene]),
    };
  };
}
