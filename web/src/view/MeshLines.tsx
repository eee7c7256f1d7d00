// The face meshes, as a path of lines each.

import { useMemo } from 'preact/hooks';

import type { DoneEstimate } from '../api/types.ts';
import { pathOf } from '../light/contours.ts';

export function MeshLines({ estimate }: { estimate: DoneEstimate }) {
  const { width_px: width, height_px: height } = estimate.photo;
  const paths = useMemo(() => estimate.faces.map((face) => pathOf(face.mesh_px)), [estimate]);
  return (
    <svg class="mesh fill" viewBox={`0 0 ${width} ${height}`} role="img" aria-label="Lines of the face meshes">
      {paths.map((path, index) => (
        <path key={index} d={path} />
      ))}
    </svg>
  );
}
