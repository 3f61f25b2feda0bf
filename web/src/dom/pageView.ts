// Where a page's scene is displayed, and what its files are loaded with.

import type { CameraController } from "../navigation/cameraController.ts";
import type { PreviewedShape } from "../preview/previewMeshes.ts";
import type { SceneRenderer } from "../render/sceneRenderer.ts";
import type { PageResources } from "./pageResources.ts";
import type { TextureReadTest } from "./textureReadTest.ts";

export interface PageView {
  readonly x3d: Element;
  readonly canvas: HTMLCanvasElement;
  readonly renderer: SceneRenderer;
  readonly cameraController: CameraController;
  readonly resources: PageResources;
  readonly textureTest: TextureReadTest;
  /** What a preview displays. */
  readonly previewed: readonly PreviewedShape[];
}
