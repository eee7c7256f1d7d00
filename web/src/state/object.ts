// The thing that is put into the photo, and where it stands.

import { useEffect, useState } from 'preact/hooks';

import { getObject } from '../api/client.ts';
import { sentenceOf } from '../api/failure.ts';
import type { DoneEstimate, Info, InsertionRequest, Material, ObjectModel } from '../api/types.ts';
import type { PhotoCamera } from '../light/camera.ts';
import { placementAt, reshaped, sizeOf, type Placement, type Size } from '../light/placement.ts';
import { useLoaded } from './loaded.ts';
import type { Chosen } from './workbench.ts';

export const ownMaterial = '';

export interface PlacedObject {
  name: string;
  material: string; // or ownMaterial
  model?: ObjectModel;
  size: Size; // the model's, or a cube's until it is there
  trouble?: string;
  placement: Placement;
  camera: PhotoCamera;
  chooseObject(name: string): void;
  chooseMaterial(name: string): void;
  place(change: (placement: Placement) => Placement): void;
  reset(): void;
}

const cube: Size = { width: 1, height: 1, depth: 1 };

export function usePlacedObject(estimate: DoneEstimate, info: Info | undefined): PlacedObject {
  const [chosenName, setName] = useState<string>();
  const [material, setMaterial] = useState(ownMaterial);
  const [shape, setShape] = useState({ size: cube, placement: placementAt(estimate.spot, cube) });
  const name = chosenName ?? firstOf(info?.objects ?? []);
  const { value: model, error } = useLoaded(name ?? null, getObject);

  useEffect(() => {
    if (!model) return;
    const size = sizeOf(model.meshes);
    setShape((before) => ({ size, placement: reshaped(before.placement, before.size, size) }));
  }, [model]);

  return {
    name: name ?? '',
    material,
    ...(model && { model }),
    ...(error !== undefined && { trouble: sentenceOf(error) }),
    ...shape,
    camera: {
      widthPx: estimate.photo.width_px,
      heightPx: estimate.photo.height_px,
      focalPx: estimate.focal_px,
    },
    chooseObject: setName,
    chooseMaterial: setMaterial,
    place: (change) => setShape(({ size, placement }) => ({ size, placement: change(placement) })),
    reset: () => setShape(({ size }) => ({ size, placement: placementAt(estimate.spot, size) })),
  };
}

// The teapot, as the page's best known thing.
function firstOf(objects: string[]): string | undefined {
  return objects.includes('pot') ? 'pot' : objects[0];
}

export function materialOf(info: Info | undefined, name: string): Material | null {
  return info?.materials.find((material) => material.name === name) ?? null;
}

export function requestFor(object: PlacedObject, light: Chosen, quality: 'preview' | 'final'): InsertionRequest {
  const { placement } = object;
  return {
    object: object.name,
    ...(object.material !== ownMaterial && { material: object.material }),
    at_px: [...placement.atPx],
    distance_m: placement.distanceM,
    height_m: placement.heightM,
    turn_deg: placement.turnDeg,
    ...(light === 'joint' ? { joint_light: true } : { face: light }),
    quality,
  };
}
