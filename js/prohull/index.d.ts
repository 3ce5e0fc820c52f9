/** A triangle mesh: three numbers for each vertex and for each face, one after the other. */
export interface MeshLike {
  vertices: Float64Array | Float32Array | number[];
  faces: Uint32Array | Uint16Array | Int32Array | number[];
}
export interface Mesh {
  vertices: Float64Array;
  faces: Uint32Array;
}

/** What every long call takes. */
export interface Running {
  /** Ends the work at once; the promise is rejected with the reason of the signal. */
  signal?: AbortSignal;
  /** Is told now and then what is being done, and how much of that, from 0 to 1. */
  progress?: (stage: string, fraction: number) => void;
}

export type Side = 'outer' | 'inner';
export type OpenShells = 'close' | 'keep';
export type Unit = 'mm' | 'cm' | 'm' | 'in' | 'ft';

/** As the options of `prohull build` and of Python's prohull.build; lengths are in the unit of the mesh. */
export interface BuildOptions extends Running {
  side?: Side;
  /** Moves vertices towards the mesh: less void, in more time. */
  tight?: boolean;
  /** Keeps the levels, for `level` and `writeLevels`. The hull is then the coarsest of them, and may be larger. There are none of tight
   * hulls and of hulls with a gap. */
  levels?: boolean;
  /** The name of the file that the hull is for: the result then has a `summary`. */
  summaryOf?: string;
  maxDistance?: number;
  maxVoidPercent?: number;
  gap?: number;
  tolerances?: Float64Array | number[];
  mirror?: 'x' | 'y' | 'z';
  repair?: 'auto' | 'none' | 'wrap';
  keepCavities?: boolean;
  openShells?: OpenShells;
  sealHoles?: number;
  /** Coordinates that STL and GLB files can hold; `write` refuses others for these formats. */
  float32Coordinates?: boolean;
  strategy?: 'lazy' | 'paper1' | 'paper2';
  bestOf?: number;
  seed?: number;
  selfIntersections?: 'by-strategy' | 'refused' | 'allowed';
  relaxGuards?: boolean;
  maxValence?: number;
  minCompactnessRatio?: number;
  sufficientCompactness?: number;
  maxNormalDeviationDegrees?: number;
  maxOverhang?: number;
}

/** All levels of a hull: numbers as in a .phull file. */
export interface Levels {
  side: Side;
  finestLevel?: 'input' | 'repaired' | 'convex-hull' | 'wrap';
  originalVertices: number;
  positions: Float64Array;
  baseCorners: Uint32Array;
  /** Six numbers for each: o, d, l, r, od, do. */
  splits: Uint32Array;
}

/** Proven: no point of the surface is farther than that. */
interface Distances {
  /** From all triangles. */
  distanceToTriangles?: number;
  /** From the solid; what closes its openings counts as part of it. It is left out where there is no solid. */
  distanceToSolid?: number;
}

/** The distances are those of a hull with a summary. */
export interface Hull extends Mesh, Distances {
  /** Proven exactly, by code that shares nothing with the construction: the hull encloses the mesh. With a summary, of the file as written. */
  certified: boolean;
  proof: '' | 'replay' | 'enclosure' | 'coverage' | 'padding';
  /** Proven least distance from the mesh, if a gap was asked for. */
  gap: number;
  targetReached: boolean;
  withinBounds: boolean;
  /** Volume of the hull / that of the mesh - 1; NaN if that is not known. */
  voidRatio: number;
  source: 'mesh' | 'convex-hull' | 'wrap';
  selfIntersections: number;
  repairs: string[];
  notes: string[];
  buildSeconds: number;
  verifySeconds: number;
  /** If they were asked for. */
  levels?: Levels;
  /** What `prohull build` prints of the hull, line by line. */
  summary?: string[];
  /** With the summary: what `prohull build` prints of it in a table of several meshes: the faces of the mesh, those of the hull, void, distance,
   * and whether it is certified. */
  tableRow?: string[];
}

export interface Verification {
  /** The verdict: `encloses`, and `keepsGap` if a gap was asked for. */
  holds: boolean;
  encloses: boolean;
  /** Exact; null if no gap was asked for, or it was not decided. */
  keepsGap: boolean | null;
  proof: 'replay' | 'enclosure' | 'coverage';
  originalClosed: boolean;
  whyNot: string;
  facesOutside: number;
  facesTooNear: number;
  facesUndecided: number;
  selfIntersections: number;
  leastDistance: number;
  originalVolume: number;
  voidRatio: number;
  notes: string[];
  worst: {face: number; point: Float64Array; distance: number}[];
}

/** Points in the solid of a closed mesh do not count in distances. */
interface Cover extends Distances {
  distanceToTriangles: number;
  certified: boolean;
  coversInside: boolean;
  volume: number;
  originalVolume: number;
  withinBounds: boolean;
  notes: string[];
  /** What `prohull convex` or `prohull spheres` prints, line by line; `summaryOf` asks for it. */
  summary?: string[];
}

export type Primitive =
  | {kind: 'box'; center: Float64Array; axes: Float64Array; halfSizes: Float64Array}
  | {kind: 'capsule'; a: Float64Array; b: Float64Array; radius: number}
  | {kind: 'sphere'; center: Float64Array; radius: number};

export interface ConvexPieces extends Cover {
  pieces: (Mesh & {primitive?: Primitive})[];
}

export interface Spheres extends Cover {
  /** Four numbers for each: centre and radius. */
  balls: Float64Array;
}

export interface Repaired extends Mesh {
  /** Every triangle of the mesh is covered, proven exactly. */
  certified: boolean;
  whyNot: string;
  source: 'mesh' | 'wrap';
  repairs: string[];
  obstacle: string;
}

export interface Inspection {
  faces: number;
  vertices: number;
  components: number;
  closedManifold: boolean;
  volume: number;
  diagonal: number;
  firstDefect: string;
  /** How often each kind of defect occurs, by what people call it. */
  defects: Record<string, number>;
}

/** What is wrong with a mesh, a file or an option; the message says what, where, and what to do. */
export class InputError extends Error {}

/** Builds a certified hull of any triangles, of at most so many faces where that is possible. */
export function build(mesh: MeshLike, targetFaces?: number, options?: BuildOptions): Promise<Hull>;
export function build(mesh: MeshLike, targetFaces: number[] | Uint32Array, options?: BuildOptions): Promise<Hull[]>;
/** The finest level of at most so many faces, which are no fewer than those of the coarsest; without a number, the coarsest. `float32Coordinates`:
 * with coordinates for STL and GLB files. `summaryOf`: the name of the file that it is for; the result then has the verdict against the finest
 * level, and what `prohull lod` prints. */
export function level(levels: Levels, faces?: number, options?: Running & {float32Coordinates?: boolean; summaryOf?: string}):
  Promise<Mesh & {certified?: boolean; summary?: string[]}>;
/** Decides exactly whether a hull encloses the original (side 'inner': whether the original encloses it). */
export function verify(
  hull: MeshLike, original: MeshLike,
  options?: Running & {side?: Side; solidOnly?: boolean; gap?: number; finiteOnly?: boolean}): Promise<Verification>;
/** Bounds of the greatest distance of a point of `from` from `to`. Both are proven. `finiteOnly` leaves out faces of `to` that are not finite. */
export function distance(
  from: MeshLike, to: MeshLike,
  options?: Running & {relativeGap?: number; finiteOnly?: boolean}): Promise<{lower: number; upper: number; farthest: Float64Array}>;
/** Covers triangles by a few convex pieces. */
export function convexPieces(
  mesh: MeshLike,
  options?: Running & {
    pieces?: number; vertices?: number; maxDistance?: number; maxVoidPercent?: number;
    shape?: 'polytope' | 'box' | 'capsule' | 'sphere'; float32Coordinates?: boolean; summaryOf?: string;
  }): Promise<ConvexPieces>;
/** Covers triangles by balls. */
export function spheres(
  mesh: MeshLike, options?: Running & {count?: number; maxDistance?: number; fill?: boolean; summaryOf?: string}): Promise<Spheres>;
/** Makes a closed solid of any triangles. */
export function repair(
  mesh: MeshLike,
  options?: Running & {spacing?: number; openShells?: OpenShells; keepCavities?: boolean;
    float32Coordinates?: boolean}): Promise<Repaired>;
/** What a mesh is, and what is wrong with it. */
export function inspect(mesh: MeshLike, running?: Running): Promise<Inspection>;
/** What a file holds. */
export interface MeshOfFile extends Mesh {
  /** Whether its numbers are metres: those of COLLADA and glTF are, and those that were read with a unit. */
  inMetres: boolean;
}
/** Reads STL, OBJ, PLY, OFF, GLB or COLLADA, plain or gzipped. Such a suffix of the name tells the format; of any other name, the
 * content does. `unit`: that of the file, whose lengths are then converted to metres; COLLADA says its own. */
export function read(bytes: ArrayBuffer | Uint8Array, name: string, options?: Running & {unit?: Unit}): Promise<MeshOfFile>;
/** The bytes of a file of that name: .stl, .obj, .ply, .off or .glb. */
export function write(mesh: MeshLike, name: string): Promise<Uint8Array>;
/** Reads the bytes of a .phull file. It does not hold the original, only the finest level, and what that is of the original. */
export function readLevels(bytes: ArrayBuffer | Uint8Array, name: string, running?: Running): Promise<Levels>;
/** The bytes of a .phull file, which `prohull info`, `lod`, `verify` and `query` read. They are not compressed. */
export function writeLevels(levels: Levels): Promise<Uint8Array>;
/** The bytes of an .obj or .glb file with an object of its own for each mesh, as `prohull convex` writes its pieces. */
export function writeSeveral(meshes: (MeshLike & {name: string})[], name: string): Promise<Uint8Array>;
/** The bytes of the .json file that `prohull spheres` writes. */
export function spheresJson(balls: Float64Array | number[], link: string): Promise<Uint8Array>;
/** A bundled sample, as `prohull sample` makes it. */
export function sample(name: string, faces?: number): Promise<Mesh>;
/** Of "0.5" or "1%" of the diagonal, in the unit of the mesh; and of "5mm", if the mesh is in metres. */
export function length(text: string, mesh: MeshLike, options?: Running & {inMetres?: boolean}): Promise<number>;
/** A certificate, as `prohull build --certificate` writes it. `original` has the bytes of the original's file, STL, OBJ, PLY or OFF, plain or gzipped; gap and
    maxDistance are what was asked for, provenGap and distance what the hull keeps. `unit`: with which the original was read. */
export function certificate(
  hull: MeshLike, original: ArrayBuffer | Uint8Array, name: string,
  options?: Running & {side?: Side; isStl?: boolean; unit?: Unit; gap?: number; provenGap?: number; maxDistance?: number;
    distance?: number}): Promise<Uint8Array>;
/** What the page of `prohull view` draws (view/scene.h); it may change with every version. */
export function scene(
  hull: (MeshLike | {levels: Levels} | {pieces: MeshLike[]} | {balls: Float64Array | number[]}) & {name: string} | null,
  original: MeshLike & {name: string} | null,
  options?: Running & {side?: Side}): Promise<{facts: string; blocks: Uint8Array}>;
/** What the page for teaching draws (js/bindings/figures.cpp); it may change with every version. */
export function figure(name: string, args: unknown[]): Promise<any>;
/** Ends idle workers, and so gives back their memory. */
export function release(): void;
