/** Why a geometry node is left out: what its fields state is none. The message is the sentence for the author. */
export class UnreadableGeometry extends Error {}
