import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { Sphere } from "three";
import { elementsOf } from "../document/elements.testing.ts";
import { SceneReader } from "../document/sceneReader.ts";
import { poseFraming } from "../navigation/cameraPose.ts";
import { CameraController } from "../navigation/cameraController.ts";
import type { CameraSetting } from "../navigation/orbit.ts";
import { unsetCamera } from "../navigation/orbit.ts";
import { instancesOf } from "../scene/sceneInstances.ts";
import { sphereAround } from "../scene/bounds.ts";
import type { PreviewScene } from "./previewScene.ts";
import { previewSceneOf, maxLights } from "./previewScene.ts";

const geometry = (base = 'base="b.png"') => `<ImageGeometry profile="compact" position="0 0 0" size="2 2 2" ${base}>
  <GeometryPatch bboxCenter="0 0 0" bboxSize="2 2 1" recordCount="3" vertexCount="3" data="p.png"/></ImageGeometry>`;
const shape = (appearance = "<Appearance><Material/></Appearance>", geometryMarkup = geometry(), attributes = "") =>
  `<Shape ${attributes}>${appearance}${geometryMarkup}</Shape>`;

function previewSceneIn(markup: string, camera: CameraSetting = unsetCamera): PreviewScene | undefined {
  return previewSceneOf(new SceneReader(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`)).read(), camera);
}

describe("the scene of a preview", () => {
  test("has the base of each shape, once for each of its instances", () => {
    const scene = previewSceneIn(
      `<Transform translation="5 0 0" DEF="t">${shape()}</Transform><Transform scale="2 2 2"><Transform USE="t"/></Transform>`,
    );
    assert.deepEqual(
      scene?.shapes.map(({ base, sceneFromShape }) => [base?.url, ...sceneFromShape.elements.slice(12, 15)]),
      [
        ["b.png", 5, 0, 0],
        ["b.png", 10, 0, 0],
      ],
    );
  });

  test("has shapes without a base, which their patches display", () => {
    const scene = previewSceneIn(shape() + shape(undefined, geometry("")));
    assert.deepEqual(
      scene?.shapes.map(({ base }) => base?.url),
      ["b.png", undefined],
    );
  });

  test("maps lattice coordinates by the geometry's position and size", () => {
    const [first] = previewSceneIn(shape())?.shapes ?? [];
    assert.ok(first);
    const { elements } = first.shapeFromStored;
    assert.deepEqual(elements.slice(12, 15), [-1, -1, -1]);
    assert.equal(elements[0], 2 / 65535);
  });

  test("leaves out hidden shapes", () => {
    assert.equal(previewSceneIn(`${shape()}${shape(undefined, geometry(""), 'visible="false"')}`)?.shapes.length, 1);
    assert.equal(previewSceneIn(`<Switch whichChoice="-1">${shape()}</Switch>`), undefined);
  });

  test("is exact unless a material has extensions or the background has pictures", () => {
    const physical = (children = "") =>
      shape(`<Appearance><PhysicalMaterial>${children}</PhysicalMaterial></Appearance>`);
    const isExact = (markup: string): boolean | undefined => previewSceneIn(markup)?.isExact;
    assert.equal(isExact(shape() + physical() + '<Background skyColor="1 0 0"/>'), true);
    assert.equal(isExact(shape() + physical('<ClearcoatMaterialExtension clearcoat="1"/>')), false);
    assert.equal(isExact(`${shape()}<Background frontUrl="front.png"/>`), false);
  });

  /** Scenes that only the runtime can display. */
  const unsupported: Readonly<Record<string, string>> = {
    "no shape": "",
    "a shape of classic": shape(undefined, geometry("").replace('"compact"', '"classic"')),
    "a shape without a base or patches": shape(undefined, geometry("").replace('data="p.png"', "")),
    "inline geometry": shape() + shape(undefined, "<Box/>"),
    "a text": shape() + shape(undefined, '<Text string="letters"/>'),
    "geometry of another shape": `<Shape><Sphere DEF="s"/></Shape>${shape(undefined, '<Sphere USE="s"/>')}${shape()}`,
    "a texture": shape('<Appearance><Material/><ImageTexture url="t.png"/></Appearance>'),
    "a transparent shape": shape('<Appearance><Material transparency="0.5"/></Appearance>'),
    "a mask": shape('<Appearance alphaMode="MASK"><Material/></Appearance>'),
    "a LOD": `<LOD range="1">${shape()}${shape()}</LOD>`,
    "an Inline": `${shape()}<Inline url="other.x3d"/>`,
    "a sky of several colours": `<Background skyColor="0 0 1 1 1 1" skyAngle="1.5"/>${shape()}`,
    "a transparent sky": `<Background transparency="0.5"/>${shape()}`,
    "a clip plane": `<ClipPlane/>${shape()}`,
    "an EnvironmentLight": `<EnvironmentLight/>${shape()}`,
    "a cube map": shape('<Appearance><Material/><ImageCubeMapTexture url="t.png"/></Appearance>'),
    fog: `<Fog visibilityRange="9"/>${shape()}`,
    "one light above the limit": "<DirectionalLight/>".repeat(maxLights + 1) + shape(),
    "more shapes than the limit": shape().repeat(300),
  };
  for (const [what, markup] of Object.entries(unsupported)) {
    test(`is undefined for ${what}`, () => {
      assert.equal(previewSceneIn(markup), undefined);
    });
  }
});

describe("the camera of a preview", () => {
  const scenes: Readonly<Record<string, string>> = {
    "no viewpoint": shape(),
    "two viewpoints": `<Viewpoint position="0 0 9"/><Viewpoint position="3 1 9" orientation="0 1 0 0.3"/>${shape()}`,
    "a viewpoint with bind": `<Viewpoint position="0 0 9"/><Transform rotation="0 1 0 1"><Viewpoint bind="true" position="0 0 4"/></Transform>${shape()}`,
    "an avatar that walks": `<NavigationInfo type="WALK" avatarSize="0.5 1.6 0.7"/><Viewpoint position="0 0 9"/>${shape()}`,
    lights: `<NavigationInfo headlight="false"/><PointLight location="1 2 3" on="false"/><SpotLight/>${shape()}`,
  };
  const cameras: readonly CameraSetting[] = [
    unsetCamera,
    { ...unsetCamera, orbit: { theta: 0.4, phi: 1, radius: { factor: 1.05 } }, target: [0, 0.5, 0], fieldOfView: 0.5 },
  ];
  for (const [what, markup] of Object.entries(scenes)) {
    test(`has the pose of the runtime's camera for ${what}`, () => {
      for (const camera of cameras) {
        const description = new SceneReader(elementsOf(`<X3D><Scene>${markup}</Scene></X3D>`)).read();
        const preview = previewSceneOf(description, camera);
        const { box, viewpoints } = instancesOf(description);
        const cameraController = new CameraController(
          () => undefined,
          () => undefined,
        );
        cameraController.setCamera(camera);
        cameraController.setScene({ sphere: sphereAround(box), viewpoints, navigation: description.navigation });
        assert.deepEqual(preview?.pose, cameraController.pose);
        assert.equal(preview.clearance, cameraController.clearance);
        assert.deepEqual(preview.sphere, sphereAround(box));
      }
    });
  }

  test("frames the whole scene by default", () => {
    assert.deepEqual(previewSceneIn(shape())?.pose, poseFraming(new Sphere(undefined, 1.5)));
  });
});
