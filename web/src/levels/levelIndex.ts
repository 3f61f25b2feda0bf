// The index of a mesh's levels of detail, whose pages arrive in any order (docs/formats/levels.md). It tells the bounds,
// errors, sizes, children and parents of groups. src/containers/levels/level_index.h has the same for all pages at once.

import type { LevelHeader, LevelPage } from "./levelPage.ts";
import { check, checkGroup, readFirstPage, readFurtherPage } from "./levelPage.ts";

/** The error code of roots, which are always open. */
export const rootErrorCode = 255;
/** The radius of a sphere that contains every other. */
export const unboundedRadius = 65535;

const none: readonly number[] = [];
const errors = Float64Array.from({ length: 256 }, (_, code) => (code === rootErrorCode ? Infinity : 2 ** (code / 8)));

/** A group's sphere and stated error in lattice steps, Infinity where they have no limit. */
export interface GroupBounds {
  x: number;
  y: number;
  z: number;
  /** The radius of the sphere around the group and its coarse form. */
  radius: number;
  /** The radius around the same centre that contains the spheres of all groups below, too, whose pages are here. */
  reach: number;
  error: number;
}

/** Groups are numbered from the highest level down: parents have lower numbers than their children. */
export class LevelIndex implements LevelHeader {
  readonly groupCount: number;
  readonly pageGroups: number;
  readonly rootCount: number;
  readonly positionBits: number;
  readonly hasNestedSpheres: boolean;
  readonly hasPoints: boolean;
  readonly hasChips: boolean;
  readonly pageBytes: Uint32Array;
  /** Levels of the mesh, 1 or more. */
  readonly levelCount: number;
  readonly #pages: (LevelPage | undefined)[];
  readonly #header: LevelHeader;
  /** By group: those of its parents that are in pages that are here, ascending. Groups may be in pages that are not. */
  readonly #parents = new Map<number, number[]>();
  /** By group, in units of centres: the radius of a sphere that contains those of all groups below. */
  readonly #reaches: number[] = [];
  /** Pages before this one are here, and each of their groups has a parent or is a root. */
  #wholePages = 0;

  /** `payload`: that of page 0. Safe for untrusted bytes. Throws DecodeError. */
  constructor(payload: Uint8Array) {
    const { header, page } = readFirstPage(payload);
    this.#header = header;
    this.groupCount = header.groupCount;
    this.pageGroups = header.pageGroups;
    this.rootCount = header.rootCount;
    this.positionBits = header.positionBits;
    this.hasNestedSpheres = header.hasNestedSpheres;
    this.hasPoints = header.hasPoints;
    this.hasChips = header.hasChips;
    this.pageBytes = header.pageBytes;
    this.levelCount = page.levels[0]! + 1;
    this.#pages = Array.from(header.pageBytes, () => undefined);
    this.#add(0, page);
  }

  /**
   * Adds a further page, in any order; nothing where it is here. Safe for untrusted bytes. Throws DecodeError, and is
   * then unchanged.
   */
  addPage(page: number, payload: Uint8Array): void {
    if (!this.hasPage(page)) this.#add(page, readFurtherPage(payload, this.#header, page));
  }

  get pageCount(): number {
    return this.#pages.length;
  }
  hasPage(page: number): boolean {
    return this.#pages[page] !== undefined;
  }
  pageOf(group: number): number {
    return Math.floor(group / this.pageGroups);
  }
  /** Whether the group's page is here. All further members may be used for such groups alone. */
  has(group: number): boolean {
    return this.hasPage(this.pageOf(group));
  }

  level(group: number): number {
    return this.#page(group).levels[group % this.pageGroups]!;
  }
  errorCode(group: number): number {
    return this.#page(group).errorCodes[group % this.pageGroups]!;
  }
  /** A coordinate of the centre of the group's sphere as stored; `axis` is 0, 1 or 2. */
  centerCode(group: number, axis: number): number {
    return this.#page(group).centers[3 * (group % this.pageGroups) + axis]!;
  }
  radiusCode(group: number): number {
    return this.#page(group).radii[group % this.pageGroups]!;
  }
  /** Sets all fields of `bounds`: one call, and no new object, for each group of each cut. */
  readBounds(group: number, bounds: GroupBounds): void {
    const { centers, radii, errorCodes } = this.#page(group);
    const i = group % this.pageGroups;
    const unit = this.positionBits > 16 ? 2 ** (this.positionBits - 16) : 1;
    bounds.x = unit * centers[3 * i]!;
    bounds.y = unit * centers[3 * i + 1]!;
    bounds.z = unit * centers[3 * i + 2]!;
    const radius = radii[i]!;
    bounds.radius = radius === unboundedRadius ? Infinity : 4 * unit * radius;
    bounds.reach = this.hasNestedSpheres ? bounds.radius : unit * this.#reaches[group]!;
    bounds.error = errors[errorCodes[i]!]!;
  }
  /** Vertices for the GPU. */
  vertices(group: number): number {
    return this.#page(group).vertices[group % this.pageGroups]!;
  }
  /** 0 of points. */
  triangles(group: number): number {
    return this.#page(group).triangles[group % this.pageGroups]!;
  }
  /** The size of the group's file. */
  bytes(group: number): number {
    return this.#page(group).bytes[group % this.pageGroups]!;
  }
  /** The size of the file of the group's image; 0: there is none. */
  chipBytes(group: number): number {
    return this.#page(group).chipBytes[group % this.pageGroups] ?? 0;
  }
  /** Columns and rows of the group's image; 0: there is none. */
  chipSize(group: number): readonly [columns: number, rows: number] {
    const { chipColumns, chipRows } = this.#page(group);
    const i = group % this.pageGroups;
    return [chipColumns[i] ?? 0, chipRows[i] ?? 0];
  }
  /** Ascending; child i is segment i of the group's file. */
  children(group: number): Uint32Array {
    const { children, childStarts } = this.#page(group);
    const i = group % this.pageGroups;
    return children.subarray(childStarts[i], childStarts[i + 1]);
  }
  /** Ascending: those on pages that are here. They are all where `missingPages` has none. */
  parents(group: number): readonly number[] {
    return this.#parents.get(group) ?? none;
  }

  /** Pages that are not here and that may hold the group or a parent of it. Until they are, it must not be opened. */
  missingPages(group: number): readonly number[] {
    if (this.#wholePages === this.#pages.length) return none;
    const own = this.pageOf(group);
    const page = this.#pages[own];
    if (page === undefined) return [own];
    if (own < this.#wholePages) return none;
    const level = this.level(group);
    const missing: number[] = [];
    let unsure: number[] = [];
    // Levels descend. A page between two that are here holds the level above unless one of them bounds it away.
    for (let before = own - 1; before >= this.#wholePages - 1 && before >= 0; --before) {
      const other = this.#pages[before];
      if (other === undefined) {
        unsure.push(before);
        continue;
      }
      if (other.levels[other.count - 1]! > level) missing.push(...unsure);
      unsure = [];
      if (other.levels[0]! > level + 1) break;
    }
    return missing;
  }

  #page(group: number): LevelPage {
    const page = this.#pages[Math.floor(group / this.pageGroups)];
    if (page === undefined) throw new Error(`group ${group} is on a page that is not here`);
    return page;
  }

  #add(number: number, page: LevelPage): void {
    this.#pages[number] = page;
    try {
      this.#checkLevels(number, page);
      this.#checkRelations(page);
    } catch (error) {
      this.#pages[number] = undefined;
      throw error;
    }
    this.#addParents(page);
    try {
      this.#checkParents();
    } catch (error) {
      this.#pages[number] = undefined;
      this.#removeParents(page);
      throw error;
    }
    if (!this.hasNestedSpheres) this.#setReaches();
  }

  /** For all groups whose pages are here: children have higher numbers than their parents. */
  #setReaches(): void {
    for (const page of this.#pages.toReversed()) {
      if (page === undefined) continue;
      const { first, count, radii, centers } = page;
      for (let i = count - 1; i >= 0; --i) {
        let reach = radii[i] === unboundedRadius ? Infinity : 4 * radii[i]!;
        for (const child of this.children(first + i)) {
          if (!this.has(child)) continue;
          const other = this.#page(child);
          const at = 3 * (child % this.pageGroups);
          const x = centers[3 * i]! - other.centers[at]!;
          const y = centers[3 * i + 1]! - other.centers[at + 1]!;
          const z = centers[3 * i + 2]! - other.centers[at + 2]!;
          reach = Math.max(reach, Math.sqrt(x * x + y * y + z * z) + this.#reaches[child]!);
        }
        this.#reaches[first + i] = reach;
      }
    }
  }

  #checkLevels(number: number, page: LevelPage): void {
    const { rootCount } = this;
    let before =
      this.#pages
        .slice(0, number)
        .findLast((other) => other !== undefined)
        ?.levels.at(-1) ?? page.levels[0]!;
    for (let i = 0; i < page.count; ++i) {
      const group = page.first + i;
      const isRoot = group < rootCount;
      const level = page.levels[i]!;
      const isOrdered = level <= before && isRoot === (level === this.levelCount - 1);
      checkGroup(isOrdered, group, "is in the wrong order of levels");
      checkGroup(isRoot === (page.errorCodes[i] === rootErrorCode), group, "has the error of a root, or lacks it");
      before = level;
    }
    const after = this.#pages.slice(number + 1).find((other) => other !== undefined);
    check(after === undefined || after.levels[0]! <= before, "has groups in the wrong order of levels");
    check(number < this.pageCount - 1 || before === 0, "has a last group that is not on level 0");
  }

  /** Compares each group with its children, and with its parents on other pages, as far as they are here. */
  #checkRelations(page: LevelPage): void {
    for (let group = page.first; group < page.first + page.count; ++group) {
      for (const parent of this.parents(group)) this.#checkChild(parent, group);
      for (const child of this.children(group)) if (this.has(child)) this.#checkChild(group, child);
    }
  }

  #checkChild(parent: number, child: number): void {
    checkGroup(this.level(child) + 1 === this.level(parent), child, "is not on the level below its parents'");
    checkGroup(this.errorCode(child) < this.errorCode(parent), child, "has no smaller error than its parents");
    const isInside = !this.hasNestedSpheres || this.#contains(parent, child);
    checkGroup(isInside, child, "lies outside of its parents' spheres");
  }

  #contains(outer: number, inner: number): boolean {
    const radius = this.radiusCode(outer);
    if (radius === unboundedRadius) return true;
    if (this.radiusCode(inner) > radius) return false;
    let square = 0;
    for (let axis = 0; axis < 3; ++axis) square += (this.centerCode(outer, axis) - this.centerCode(inner, axis)) ** 2;
    return square <= (4 * (radius - this.radiusCode(inner))) ** 2;
  }

  #addParents(page: LevelPage): void {
    for (let group = page.first; group < page.first + page.count; ++group)
      for (const child of this.children(group)) {
        const parents = this.#parents.get(child);
        if (parents === undefined) this.#parents.set(child, [group]);
        else {
          const at = parents.findLastIndex((other) => other < group) + 1;
          parents.splice(at, 0, group);
        }
      }
  }

  #removeParents({ first, count, children }: LevelPage): void {
    for (const child of children) {
      const parents = (this.#parents.get(child) ?? []).filter((parent) => parent < first || parent >= first + count);
      if (parents.length > 0) this.#parents.set(child, parents);
      else this.#parents.delete(child);
    }
  }

  /** Groups lack parents for certain where all pages before are here. */
  #checkParents(): void {
    let whole = this.#wholePages;
    for (let page = this.#pages[whole]; page !== undefined; page = this.#pages[++whole])
      for (let group = page.first; group < page.first + page.count; ++group)
        checkGroup(group < this.rootCount || this.#parents.has(group), group, "has no parent");
    this.#wholePages = whole;
  }
}
