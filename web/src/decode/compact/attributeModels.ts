// The layout of the models of an attribute's stream, the same for every kind: the index of the first model of each
// group (docs/formats/compact.md, end of "Attributes").

import { numberModelCount } from "./rangeDecoder.ts";

/** REPEAT: whether a wedge has the value of the previous wedge of its vertex. */
export const repeatModel = 0;
/** CHOICE: which prediction the encoder chose. */
export const choiceModels = repeatModel + 1;
/** EXACT: whether a normal is its prediction. */
export const exactModels = choiceModels + 24;
/** FLIP: whether the dominant component of a normal has the other sign than its prediction. */
export const flipModel = exactModels + 2;
/** FIRST: the residual of the first component. */
export const firstModels = flipModel + 1;
/** SECOND: the residuals of further components, by the size of the residual before. */
export const secondModels = firstModels + numberModelCount;
export const attributeModelCount = secondModels + 93 * numberModelCount;
