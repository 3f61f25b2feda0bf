// Images of vertex data, in a module of their own (document/parts.ts): files of compact are none.

import type { decodeDataImage } from "../decode/image.ts";
import type { checkImage } from "../decode/imageFile.ts";
import { LateModule } from "../document/lateModule.ts";

/** What the module adds. */
export interface DataImages {
  readonly check: typeof checkImage;
  readonly decode: typeof decodeDataImage;
}

export const lateDataImages = new LateModule<DataImages>("images of vertex data");
