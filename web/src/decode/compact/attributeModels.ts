// The layout of the models of an attribute's stream, the same for every kind: the index of the first model of each
// group (docs/formats/compact.md, end of "Attributes").

import { numberModelCount } from "./rangeDecoder.ts";

export const repeatModel = 0;
export const choiceModels = repeatModel + 1;
export const exactModels = choiceModels + 24;
export const flipModel = exactModels + 2;
export const firstModels = flipModel + 1;
export const secondModels = firstModels + numberModelCount;
export const attributeModelCount = secondModels + 93 * numberModelCount;
