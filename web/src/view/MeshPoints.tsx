// The face meshes' points, as one path of dots.

import { useMemo } from 'preact/hooks';

import type { DoneEstimate } from '../api/types.ts';

export function MeshPoints({ estimate }: { estimate: DoneEstimate }) {
  const { width_px: width, height_px: height } = estimate.photo;
  const dots = useMemo(() => estimate.faces.map((face) => dotsOf(face.mesh_px)), [estimate]);
  return (
    <svg class="mesh fill" viewBox={`0 0 ${width} ${height}`} role="img" aria-label="Points of the face meshes">
      {dots.map((path, index) => (
        <path key={index} d={path} />
      ))}
    </svg>
  );
}

// Lines without length, which round caps make dots of one size on the screen.
function dotsOf(mesh: number[]): string {
  let path = '';
  for (let i = 0; i + 1 < mesh.length; i += 2) path += `M${mesh[i]!.toFixed(1)} ${mesh[i + 1]!.toFixed(1)}h0`;
  return path;
}
