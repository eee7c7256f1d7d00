// What is chosen on the page of a done estimate.

import { useState } from 'preact/hooks';

import type { DoneEstimate, Face, LightReport } from '../api/types.ts';

// Whose light is looked at: one face's, or the one map of all.
export type Chosen = number | 'joint';

export interface Subject {
  chosen: Chosen;
  folder: string; // of its maps
  light: LightReport;
  face: Face | null; // null for all faces together
}

export function subjectOf(estimate: DoneEstimate, chosen: Chosen): Subject {
  const { report, faces, joint_folder: joint } = estimate;
  if (chosen === 'joint' && joint !== null && report.joint_light) {
    return { chosen, folder: joint, light: report.joint_light, face: null };
  }
  const index = chosen === 'joint' ? estimate.largest_face : chosen;
  return { chosen: index, folder: faces[index]!.folder, light: report.faces[index]!.light, face: faces[index]! };
}

export function pathIn(folder: string, file: string): string {
  return folder === '' ? file : `${folder}/${file}`;
}

export interface Shown {
  object: boolean;
  faces: boolean;
  mesh: boolean;
}

export function useShown(): [Shown, (part: Partial<Shown>) => void] {
  const [shown, setShown] = useState<Shown>({ object: true, faces: true, mesh: false });
  return [shown, (part) => setShown((before) => ({ ...before, ...part }))];
}
