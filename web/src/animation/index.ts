// What a page loads where its document has nodes that send events. Imports nothing from other folders, so that it is a
// module of its own.

export { PageAnimation } from "./page/pageAnimation.ts";
