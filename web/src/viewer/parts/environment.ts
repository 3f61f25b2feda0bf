// The part "environment": what is around shapes, clip planes, fogs and scopes of lights.

import { cubeMapProblemOf } from "../../render/environment/cubeLayout.ts";
import { addEffects, effectUniformsOf } from "../../render/environment/effectShaders.ts";
import { setEnvironmentLight } from "../../render/environment/environmentLight.ts";
import { setFogs } from "../../render/environment/fogs.ts";
import { lateEnvironment } from "../../render/environment/lateEnvironment.ts";
import { SceneSurroundings } from "../../render/environment/sceneSurroundings.ts";
import { makePicture } from "../../render/frames/panorama.ts";
import { makeSky } from "../../render/frames/sky.ts";

export function add(): void {
  lateEnvironment.add({
    surroundings: (uniforms) => new SceneSurroundings(uniforms),
    sky: makeSky,
    picture: makePicture,
    setFogs,
    setEnvironmentLight,
    effectUniformsOf,
    addEffects,
    cubeMapProblemOf,
  });
}
