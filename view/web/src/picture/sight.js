// What is seen along a line of sight: a face of a body, or the filling of a section.

import * as THREE from 'three';

const caster = new THREE.Raycaster();
const ON_PLANE = 1e-5;  // the longest side of a scene has length 1

/** Whether a section, if there is one, cuts a point away. */
export const isCutAway = (point, cut) => cut !== null && point.clone().sub(cut.point).dot(cut.direction) > ON_PLANE;

/** Where a ray of the scene meets faces of the body, nearest first. */
export function facesAlong(body, ray) {
  caster.ray.copy(ray);
  return caster.intersectObject(body.surface, false).map((hit) => ({...hit, body}));
}

/** The face through which a ray leaves the body, if the body is solid where the ray begins. */
function leaves(body, ray) {
  caster.ray.copy(ray);
  const [backs, fronts] = body.counting.map((mesh) => caster.intersectObject(mesh, false));
  return backs.length > fronts.length ? backs[0] : null;
}

/** The filling that a ray meets first. What fills the inside is painted last. */
function filling(bodies, ray, cut) {
  const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(cut.direction, cut.point), point = new THREE.Vector3();
  if (plane.distanceToPoint(ray.origin) <= 0 || !ray.intersectPlane(plane, point)) return null;
  const onwards = new THREE.Ray(point, ray.direction);
  const [body] = bodies.filter((found) => found.closed && leaves(found, onwards)).sort((a, b) => b.order - a.order);
  return body ? {body, point, face: {a: leaves(body, onwards).face.a}, faceIndex: null} : null;
}

/** The first face along a ray that no section cuts away; `faceIndex` is null on the filling of a section. */
export function firstSeen(bodies, ray, cut) {
  const faces = () => bodies.flatMap((body) => facesAlong(body, ray).filter(({point}) => !isCutAway(point, cut)).slice(0, 1));
  return (cut && filling(bodies, ray, cut)) ?? faces().sort((a, b) => a.distance - b.distance)[0] ?? null;
}
