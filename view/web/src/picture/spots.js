// Two points, A and B, the way between them, and faces, on top of everything.

import * as THREE from 'three';
import {markSprite} from './marks.js';

const COLOR = '#0b62a8', FACE = '#d6006c';

export class Spots {
  constructor() {
    this.marks = ['A', 'B'].map((name) => markSprite(name, COLOR));
    const how = {color: COLOR, depthTest: false, transparent: true};
    this.way = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(how));
    this.faces = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({...how, color: FACE, opacity: 0.5, side: THREE.DoubleSide}));
    for (const object of [this.faces, this.way]) Object.assign(object, {renderOrder: 95, frustumCulled: false});
    this.group = new THREE.Group().add(...this.marks, this.faces, this.way);
    this.show([], []);
  }

  /** `corners` are those of the faces, three for each. */
  show(points, corners) {
    this.marks.forEach((mark, i) => {
      mark.visible = i < points.length;
      if (mark.visible) mark.position.copy(points[i]);
    });
    for (const [object, places] of [[this.way, points], [this.faces, corners]]) {
      object.geometry.dispose();
      object.geometry = new THREE.BufferGeometry().setFromPoints(places);
      object.visible = places.length > 1;
    }
  }
}
