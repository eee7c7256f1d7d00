// A built-in object as three.js's meshes.

import { Box3, BufferAttribute, BufferGeometry, Group, Mesh, Vector3 } from 'three';

import type { Material, ObjectModel } from '../api/types.ts';
import type { Size } from '../light/placement.ts';
import { surfaceOf, type LampWidth } from './material.ts';

export interface StandingModel {
  group: Group; // its underside's middle in the origin
  box: Box3; // of the group, unplaced
  size: Size;
  glass: boolean;
  dispose(): void;
}

export function standing(model: ObjectModel, material: Material | null, lampWidth: LampWidth): StandingModel {
  const group = new Group();
  const materials = model.materials.map((own) => material ?? own);
  const surfaces = materials.map((each) => surfaceOf(each, lampWidth));
  for (const mesh of model.meshes) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(mesh.positions), 3));
    geometry.setAttribute('normal', new BufferAttribute(new Float32Array(mesh.normals), 3));
    geometry.setIndex(new BufferAttribute(new Uint32Array(mesh.triangles), 1));
    const part = new Mesh(geometry, surfaces[mesh.material]);
    part.castShadow = true;
    part.receiveShadow = true;
    group.add(part);
  }
  const box = new Box3().setFromObject(group);
  const toFoot = new Vector3(-(box.min.x + box.max.x) / 2, -box.min.y, -(box.min.z + box.max.z) / 2);
  for (const part of group.children) part.position.copy(toFoot);
  box.translate(toFoot);
  return {
    group,
    box,
    size: { width: box.max.x - box.min.x, height: box.max.y - box.min.y, depth: box.max.z - box.min.z },
    glass: materials.every((each) => each.kind === 'glass'),
    dispose() {
      for (const part of group.children) (part as Mesh).geometry.dispose();
      for (const surface of surfaces) surface.dispose();
    },
  };
}
