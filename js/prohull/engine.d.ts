import type {BuildOptions, Hull, Levels, Mesh, MeshLike, Running} from './index.js';
import type * as prohull from './index.js';

type Progress = (stage: string, fraction: number) => boolean | void;
type Now<Call> = Call extends (mesh: infer A, options?: infer B) => Promise<infer R>
  ? (mesh: A, options?: Omit<NonNullable<B>, keyof Running>, progress?: Progress) => R : never;
type NowOfTwo<Call> = Call extends (first: infer A, second: infer B, options?: infer C) => Promise<infer R>
  ? (first: A, second: B, options?: Omit<NonNullable<C>, keyof Running>, progress?: Progress) => R : never;

/** The library on the thread that calls it. A call stops where `progress` returns false. */
export interface Engine {
  build(mesh: MeshLike, targetFaces?: number, options?: Omit<BuildOptions, keyof Running>, progress?: Progress): Hull;
  build(mesh: MeshLike, targetFaces: number[] | Uint32Array, options?: Omit<BuildOptions, keyof Running>, progress?: Progress): Hull[];
  level(levels: Levels, faces?: number, options?: {float32Coordinates?: boolean; summaryOf?: string}, progress?: Progress):
    Mesh & {certified?: boolean; summary?: string[]};
  verify: NowOfTwo<typeof prohull.verify>;
  distance: NowOfTwo<typeof prohull.distance>;
  convexPieces: Now<typeof prohull.convexPieces>;
  spheres: Now<typeof prohull.spheres>;
  repair: Now<typeof prohull.repair>;
  inspect(mesh: MeshLike): prohull.Inspection;
  sample(name: string, faces?: number): Mesh;
  length(text: string, mesh: MeshLike, options?: {inMetres?: boolean}): number;
  certificate(hull: MeshLike, original: ArrayBuffer | Uint8Array, name: string,
    options?: Omit<NonNullable<Parameters<typeof prohull.certificate>[3]>, keyof Running>): Promise<Uint8Array>;
  scene(hull: Parameters<typeof prohull.scene>[0], original: Parameters<typeof prohull.scene>[1], options?: {side?: prohull.Side},
    progress?: Progress): {facts: string; blocks: Uint8Array};
  figure(name: string, args: unknown[]): any;
  read(bytes: ArrayBuffer | Uint8Array, name: string, options?: {unit?: prohull.Unit}): Promise<prohull.MeshOfFile>;
  write(mesh: MeshLike, name: string): Uint8Array;
  readLevels(bytes: ArrayBuffer | Uint8Array, name: string): Levels;
  writeLevels(levels: Levels): Uint8Array;
  writeSeveral(...args: Parameters<typeof prohull.writeSeveral>): Uint8Array;
  spheresJson(...args: Parameters<typeof prohull.spheresJson>): Uint8Array;
  memory(): number;
}

export {InputError} from './index.js';
/** `wasm` is the compiled module.wasm of this package. */
export function loadEngine(wasm: WebAssembly.Module): Promise<Engine>;
