// How surfaces, edges and sections are drawn. Colours are those of the screen; nothing is converted.

import * as THREE from 'three';
import {VIRIDIS_GLSL} from '../data/heat.js';

const VERTEX = `
attribute float heat;
varying vec3 vPlace;
varying vec3 vSeen;
varying vec3 vSight;
varying float vHeat;
#ifdef PARTS
attribute vec3 shift;
attribute vec3 tint;
uniform float explosion;
varying vec3 vTint;
#endif
void main() {
  vec3 place = position;
  vHeat = heat;
#ifdef PARTS
  place += explosion * shift;
  vTint = tint;
#endif
  vPlace = (modelMatrix * vec4(place, 1.0)).xyz;
  vec4 seen = viewMatrix * vec4(vPlace, 1.0);
  vSeen = seen.xyz;
  vSight = projectionMatrix[3][3] == 1.0 ? vec3(0.0, 0.0, 1.0) : vSeen;  // orthographic or not
  gl_Position = projectionMatrix * seen;
}`;

const CUT = `
uniform vec4 plane;
varying vec3 vPlace;
bool isCutAway() { return dot(plane.xyz, vPlace) > plane.w; }
`;

const SURFACE = `
${CUT}
uniform vec3 color;
uniform float opacity;
uniform bool showsHeat;
uniform float heatFactor;
varying vec3 vSeen;
varying vec3 vSight;
varying float vHeat;
#ifdef PARTS
uniform bool showsParts;
varying vec3 vTint;
#endif
${VIRIDIS_GLSL}
void main() {
  if (isCutAway()) discard;
  vec3 normal = normalize(cross(dFdx(vSeen), dFdy(vSeen)));
  float light = 0.5 + 0.46 * max(dot(normal, normalize(vec3(-0.35, 0.55, 0.9))), 0.0) +
                0.16 * max(dot(normal, normalize(vec3(0.8, -0.2, 0.5))), 0.0);
  vec3 base = showsHeat ? viridis(1.0 - clamp(vHeat * heatFactor, 0.0, 1.0)) : color;
#ifdef PARTS
  if (showsParts && !showsHeat) base = vTint;
#endif
  if (!gl_FrontFacing) base = mix(base, vec3(0.25, 0.2, 0.3), 0.45);
  // Like glass: denser where it is seen from the side.
  float seen = opacity < 1.0 ? opacity * (0.5 + 2.0 * pow(1.0 - abs(normalize(vSight).z * normal.z), 2.0)) : 1.0;
  gl_FragColor = vec4(base * (showsHeat ? 0.4 + 0.62 * light : light), min(seen, 1.0));
}`;

const FLAT = `
${CUT}
uniform vec3 color;
uniform float opacity;
void main() {
  if (isCutAway()) discard;
  gl_FragColor = vec4(color, opacity);
}`;

const CAP = `
uniform vec3 color;
uniform float stripes;
varying vec3 vPlace;
void main() {
  float line = mod(gl_FragCoord.x + gl_FragCoord.y, 9.0 * stripes) < 1.6 * stripes ? 0.72 : 1.0;
  gl_FragColor = vec4(color * (stripes > 0.0 ? line : 1.0), 1.0);
}`;

/** All materials share the plane, and how parts are shown. */
export const plane = {value: new THREE.Vector4(0, 0, 0, 1)};
export const explosion = {value: 0};
export const showsParts = {value: false};

const material = (fragmentShader, uniforms, options) =>
    new THREE.ShaderMaterial({vertexShader: VERTEX, fragmentShader, uniforms: {plane, explosion, showsParts, ...uniforms}, ...options});

/** Where surfaces touch, the one with less `depth` is seen. */
export function surfaceMaterial(color, depth) {
  return material(SURFACE, {color: {value: new THREE.Color(...color)}, opacity: {value: 1}, showsHeat: {value: false},
    heatFactor: {value: 1}}, {
    side: THREE.DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: depth,
    polygonOffsetUnits: 2 * depth,
  });
}

export function edgeMaterial() {
  return material(FLAT, {color: {value: new THREE.Color(0, 0, 0)}, opacity: {value: 0.45}},
      {transparent: true, depthWrite: false});
}

/** Lines that are seen through everything. */
export function defectMaterial() {
  return material(FLAT, {color: {value: new THREE.Color(...rgb('#c2185b'))}, opacity: {value: 1}}, {transparent: true, depthTest: false});
}

/** Counts where the plane is inside of a closed surface: twice, for back and front faces. */
export function countingMaterial(side, operation) {
  return material(FLAT, {color: {value: new THREE.Color(0, 0, 0)}, opacity: {value: 1}}, {
    side,
    colorWrite: false,
    depthWrite: false,
    depthTest: false,
    stencilWrite: true,
    stencilFunc: THREE.AlwaysStencilFunc,
    stencilFail: operation,
    stencilZFail: operation,
    stencilZPass: operation,
  });
}

export function capMaterial(color, stripes) {
  return material(CAP, {color: {value: new THREE.Color(...color)}, stripes: {value: stripes}}, {
    side: THREE.DoubleSide,
    stencilWrite: true,
    stencilRef: 0,
    stencilFunc: THREE.NotEqualStencilFunc,
    stencilFail: THREE.ReplaceStencilOp,
    stencilZFail: THREE.ReplaceStencilOp,
    stencilZPass: THREE.ReplaceStencilOp,
  });
}

/** "#56b4e9" as three numbers */
export const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
