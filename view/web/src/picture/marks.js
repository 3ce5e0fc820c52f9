// Marks of points.

import * as THREE from 'three';

/** A disk with a text, always of one size on the screen. */
export function markSprite(text, color) {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const draw = canvas.getContext('2d');
  draw.beginPath();
  draw.arc(32, 32, 24, 0, 2 * Math.PI);
  draw.fillStyle = color;
  draw.fill();
  draw.lineWidth = 5;
  draw.strokeStyle = '#ffffff';
  draw.stroke();
  draw.fillStyle = '#ffffff';
  draw.font = 'bold 28px system-ui, sans-serif';
  draw.textAlign = 'center';
  draw.textBaseline = 'middle';
  draw.fillText(text, 32, 34);
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({
    map: new THREE.CanvasTexture(canvas), sizeAttenuation: false, depthTest: false, transparent: true}));
  sprite.renderOrder = 100;
  return sprite;
}
