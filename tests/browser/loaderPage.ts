// Runs in the browser: one three.js app that draws either a scene of the loader or plain buffers of the same mesh.
// Bundled by loader.test.ts.

import {
  ACESFilmicToneMapping,
  AmbientLight,
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Fog,
  FrontSide,
  LineBasicMaterial,
  LineSegments,
  LoadingManager,
  type LOD,
  Mesh,
  MeshStandardMaterial,
  MeshToonMaterial,
  PerspectiveCamera,
  PlaneGeometry,
  PointLight,
  Points,
  PointsMaterial,
  Raycaster,
  Scene,
  SpotLight,
  SRGBColorSpace,
  Vector2,
  Vector3,
  WebGLRenderer,
  type Light,
  type Object3D,
} from "three";
import { ImgeoLoader, type ImgeoScene } from "../../web/src/loader/index.ts";

/** As in reference.ts; if there are triangles, lines are not drawn, and if there are lines, points are not. */
export interface PlainBuffers {
  positions: number[];
  normals?: number[];
  /** sRGB, 0..1. */
  colors?: number[];
  triangles: number[];
  /** Whether both sides of triangles are drawn. */
  isDoubleSided?: boolean;
  lines: number[];
}

export interface AppRequest {
  light: "directional" | "spot" | "point";
  what: "scene" | "plain" | "nothing";
  castShadow: boolean;
}

export interface Found {
  point: number[];
  normal: number[] | undefined;
  name: string;
  triangle: number | undefined;
}

declare global {
  interface Window {
    app: {
      /** Sets the mesh that "plain" draws, and its X3D material. */
      setPlain: (mesh: PlainBuffers, material: { diffuseColor: [number, number, number]; shininess: number }) => void;
      loader: ImgeoLoader;
      /** Loads scene.x3d completely. */
      load: () => Promise<void>;
      draw: (request: AppRequest) => Promise<void>;
      /** The loader's events and callbacks while it loads `url`, in order. */
      log: (url: string) => Promise<string[]>;
      /** Aborts the load that is being logged. */
      abort: () => void;
      /** Picks at a pixel of the last picture, by the GPU and by three.js' Raycaster. */
      pick: (x: number, y: number) => { gpu: Found | undefined; ray: Found | undefined };
      /** Disposes of the loaded scene. */
      dispose: () => void;
      inspect: () => Promise<Record<string, unknown>>;
      /** Draws the loaded scene from a camera position; returns the displayed level of its LOD. */
      drawFrom: (from: [number, number, number]) => Promise<number>;
      /** True if no request of the loaded scene is pending. */
      isSettled: () => boolean;
      /** Names of the objects below the loaded scene, and of their parents. */
      names: () => Record<string, string>;
    };
  }
}

const renderer = new WebGLRenderer({ antialias: true });
renderer.setPixelRatio(devicePixelRatio);
renderer.setSize(innerWidth, innerHeight);
renderer.setClearColor(0xffffff, 1);
renderer.shadowMap.enabled = true;
renderer.toneMapping = ACESFilmicToneMapping;
document.body.append(renderer.domElement);

const camera = new PerspectiveCamera(45, innerWidth / innerHeight, 0.1, 100);
camera.position.set(5, 6, 11);
camera.lookAt(0, -1, 0);

let loaded: ImgeoScene | undefined;
let plain: Object3D | undefined;
let aborter = new AbortController();

function sceneWith(light: Light): Scene {
  const scene = new Scene();
  scene.background = new Color(0x8899aa);
  scene.fog = new Fog(0x8899aa, 6, 40);
  const floor = new Mesh(new PlaneGeometry(30, 30), new MeshStandardMaterial({ color: 0xbbbbbb }));
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -4;
  floor.receiveShadow = true;
  light.castShadow = true;
  scene.add(floor, light, new AmbientLight(0xffffff, 0.6));
  return scene;
}

function lightOf(kind: AppRequest["light"]): Light {
  const light =
    kind === "directional"
      ? new DirectionalLight(0xffffff, 2.5)
      : kind === "spot"
        ? new SpotLight(0xffffff, 400, 40, 0.7)
        : new PointLight(0xffffff, 300, 40);
  if (light instanceof DirectionalLight)
    Object.assign(light.shadow.camera, { left: -8, right: 8, top: 8, bottom: -8, near: 0.5, far: 30 });
  light.position.set(3, 8, 4);
  light.shadow.mapSize.set(1024, 1024);
  light.shadow.bias = -0.002;
  return light;
}

function plainObject(
  { positions, normals, colors, triangles, isDoubleSided = false, lines }: PlainBuffers,
  color: Color,
  shininess: number,
): Object3D {
  const geometry = new BufferGeometry();
  const set = (name: string, values: number[]): void =>
    void geometry.setAttribute(name, new BufferAttribute(Float32Array.from(values), 3));
  set("position", positions);
  if (normals) set("normal", normals);
  if (colors) set("color", linear(colors));
  const colorOptions = { color: colors ? 0xffffff : color, vertexColors: colors !== undefined };
  if (triangles.length > 0) {
    geometry.setIndex(triangles);
    const roughness = Math.sqrt(2 / (shininess * 128 + 2));
    return new Mesh(
      geometry,
      new MeshStandardMaterial({
        ...colorOptions,
        roughness,
        metalness: 0,
        side: isDoubleSided ? DoubleSide : FrontSide,
      }),
    );
  }
  if (lines.length === 0)
    return new Points(
      geometry,
      new PointsMaterial({ ...colorOptions, size: 2 * devicePixelRatio, sizeAttenuation: false }),
    );
  geometry.setIndex(lines);
  return new LineSegments(geometry, new LineBasicMaterial(colorOptions));
}

/** Converts sRGB triples to three.js' linear working space. */
function linear(colors: number[]): number[] {
  return colors.map((value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
}

function meshesIn(object: Object3D): Mesh[] {
  const meshes: Mesh[] = [];
  object.traverse((part) => {
    if (part instanceof Mesh) meshes.push(part as Mesh);
  });
  return meshes;
}

/** A LoadingManager that logs the file names of its items. */
function loggingManager(lines: string[]): LoadingManager {
  const manager = new LoadingManager();
  const { itemStart, itemEnd, itemError } = manager;
  const note = (what: string, item: string): void => void lines.push(`${what} ${item.replace(/.*\//, "")}`);
  manager.itemStart = (item) => {
    note("start", item);
    itemStart(item);
  };
  manager.itemEnd = (item) => {
    note("end", item);
    itemEnd(item);
  };
  manager.itemError = (item) => {
    note("error", item);
    itemError(item);
  };
  return manager;
}

window.app = {
  loader: new ImgeoLoader(),

  setPlain(mesh, { diffuseColor, shininess }) {
    plain = plainObject(mesh, new Color().setRGB(...diffuseColor, SRGBColorSpace), shininess);
  },

  async load() {
    loaded = await window.app.loader.loadAsync("scene.x3d");
    await loaded.complete;
  },

  async draw({ light, what, castShadow }) {
    const scene = sceneWith(lightOf(light));
    const object = what === "scene" ? loaded : what === "plain" ? plain : undefined;
    if (object) {
      // As in apps: applies to all objects of the scene, now and later.
      object.traverse((part) => {
        Object.assign(part, { castShadow, receiveShadow: true });
      });
      scene.add(object);
    }
    renderer.render(scene, camera);
    await new Promise(requestAnimationFrame);
  },

  abort() {
    aborter.abort();
  },

  async log(url) {
    const lines: string[] = [];
    aborter = new AbortController();
    const manager = loggingManager(lines);
    const all = new Promise<void>((resolve) => {
      manager.onLoad = () => {
        lines.push("manager.onLoad");
        resolve();
      };
    });
    const onProgress = ({ loaded, total }: ProgressEvent): void => {
      lines.push(loaded <= total ? "progress" : `progress ${loaded} of ${total}`);
    };
    await new Promise<void>((resolve) => {
      const onLoad = (scene: ImgeoScene): void => {
        lines.push(
          "onLoad",
          `showing ${meshesIn(scene)
            .map(({ parent }) => parent?.name)
            .toSorted()
            .join(", ")}`,
        );
        loaded = scene;
        void scene.complete.then(
          () => {
            lines.push("complete");
            resolve();
          },
          (error: unknown) => {
            lines.push((error as Error).name);
            resolve();
          },
        );
      };
      const onError = (error: unknown): void => {
        lines.push(`onError ${String(error)}`);
        resolve();
      };
      new ImgeoLoader(manager)
        .setPath("./")
        .setWorkerUrl("/worker.js")
        .load(url, onLoad, onProgress, onError, { signal: aborter.signal });
    });
    await all;
    return lines;
  },

  pick(x, y) {
    if (loaded === undefined) throw new Error("nothing is loaded");
    const hit = loaded.pick(renderer, camera, x, y);
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2((2 * (x + 0.5)) / innerWidth - 1, 1 - (2 * (y + 0.5)) / innerHeight), camera);
    const [ray] = caster.intersectObject(loaded);
    const normal = ray?.face?.normal.clone().transformDirection(ray.object.matrixWorld);
    return {
      gpu: hit && {
        point: hit.point.toArray(),
        normal: hit.normal?.toArray(),
        name: hit.object.name,
        triangle: hit.triangle,
      },
      ray: ray && {
        point: ray.point.toArray(),
        normal: normal?.toArray(),
        name: ray.object.parent?.name ?? "",
        triangle: ray.faceIndex ?? undefined,
      },
    };
  },

  dispose() {
    loaded?.dispose();
    loaded = undefined;
  },

  async drawFrom(from) {
    if (loaded === undefined) throw new Error("nothing is loaded");
    const scene = new Scene().add(loaded);
    camera.position.set(...from);
    camera.lookAt(0, 0, 0);
    renderer.render(scene, camera);
    await new Promise(requestAnimationFrame);
    const lod = loaded.getObjectByProperty("isLOD", true) as LOD;
    return lod.getCurrentLevel();
  },

  isSettled() {
    return loaded?.transfers.every(({ state }) => state === "ready" || state === "failed") === true;
  },

  names() {
    const names: Record<string, string> = {};
    loaded?.traverse(({ name, type }) => {
      if (name !== "") names[name] = type;
    });
    return names;
  },

  async inspect() {
    const loader = new ImgeoLoader().setMaterial(
      (material) =>
        new MeshToonMaterial({
          color: new Color().setRGB(...(material.kind === "phong" ? material.diffuseColor : material.emissiveColor)),
        }),
    );
    const object = (loaded = await loader.loadAsync("scene.x3d"));
    object.castShadow = true; // must also apply to objects that come later
    await object.complete;
    const meshes = meshesIn(object);
    const scene = sceneWith(lightOf("directional"));
    scene.add(object);
    renderer.render(scene, camera);
    const size = (box: Box3): number[] => box.getSize(new Vector3()).toArray();
    return {
      meshes: meshes.length,
      toon: meshes.every(({ material }) => material instanceof MeshToonMaterial),
      casting: meshes.every(({ castShadow }) => castShadow),
      byName: object.getObjectByName("trefoil") !== undefined,
      lights: object.getObjectByProperty("isLight", true) !== undefined,
      size: size(object.box),
      sizeOfObjects: size(new Box3().setFromObject(object)),
    };
  },
};
