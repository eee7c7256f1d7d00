// The contract's shapes, as in public/openapi.json; names are the contract's.

export type FailureKind =
  | 'usage'
  | 'input'
  | 'no_face'
  | 'model'
  | 'output'
  | 'device'
  | 'not_found'
  | 'too_large'
  | 'wrong_type'
  | 'not_ready'
  | 'busy'
  | 'forbidden'
  | 'unexpected';

export interface FailureBody {
  kind: FailureKind;
  message: string;
}

export interface Material {
  name: string;
  kind: 'diffuse' | 'metal' | 'plastic' | 'glass';
  colour_rgb: [number, number, number];
  roughness: number;
  index: number;
}

export interface Info {
  version: string;
  max_upload_bytes: number;
  history_limit: number;
  objects: string[];
  materials: Material[];
  samples: { name: string; title: string }[];
}

interface ObjectMesh {
  material: number;
  positions: number[];
  normals: number[];
  triangles: number[];
}

export interface ObjectModel {
  name: string;
  materials: Material[];
  meshes: ObjectMesh[];
}

export interface JobState {
  state: 'waiting' | 'running' | 'done' | 'failed';
  stage?: string;
  share?: number;
  elapsed_seconds: number;
  seconds_left?: number;
  error?: FailureBody;
}

export interface OutputFile {
  path: string;
  bytes: number;
  media_type: string;
}

export interface EstimateSummary {
  id: string;
  name: string;
  job: JobState;
  faces?: number;
}

export interface Face {
  box_px: [number, number, number, number];
  crop_px: [number, number, number, number]; // what its layers show of the photo
  mesh_px: number[];
  folder: string;
}

interface Spot {
  at_px: [number, number];
  distance_m: number;
  height_m: number;
}

// Of report.json only what the page shows.
export interface MainLight {
  direction: [number, number, number];
  azimuth_deg: number;
  elevation_deg: number;
  colour_rgb: [number, number, number];
  irradiance: number;
  solid_angle_sr: number;
  share_of_energy: number;
}

export interface LightReport {
  main_lights: MainLight[];
}

export interface Report {
  camera: { focal_px: number; focal_source: string };
  faces: { position_m: [number, number, number]; yaw_deg: number; light: LightReport }[];
  joint_light?: LightReport;
  warnings: string[];
}

// Of room.json.
export interface Lamp {
  near: boolean;
  direction: [number, number, number];
  colour_rgb: [number, number, number];
  position_m?: [number, number, number];
  position_deviation_m?: number;
  intensity?: number;
  irradiance?: number;
  seen_by: { face: number; light: number }[];
}

export interface Room {
  lamps: Lamp[];
}

// What an estimate has once its job is done.
interface EstimateResult {
  photo: { width_px: number; height_px: number };
  focal_px: number;
  up_cam: [number, number, number];
  faces: Face[];
  largest_face: number;
  joint_folder: string | null;
  spot: Spot;
  room: Room | null;
  report: Report;
  files: OutputFile[];
}

interface EstimateHead {
  id: string;
  name: string;
  job: JobState;
}
export type Estimate = EstimateHead & Partial<EstimateResult>;
export type DoneEstimate = EstimateHead & EstimateResult;

// Whether the server can show the photo: it has read it then.
export function hasPhoto(job: JobState | undefined): boolean {
  return job?.state === 'done' || job?.error?.kind === 'no_face';
}

export function isDone(estimate: Estimate): estimate is DoneEstimate {
  return estimate.job.state === 'done' && estimate.faces !== undefined;
}

export interface InsertionRequest {
  object: string;
  material?: string;
  kind?: Material['kind'];
  colour_rgb?: [number, number, number];
  roughness?: number;
  index?: number;
  at_px?: [number, number];
  beside_m?: number;
  distance_m?: number;
  height_m?: number;
  turn_deg?: number;
  ground?: boolean;
  face?: number;
  joint_light?: boolean;
  quality?: 'preview' | 'final';
}

export interface Insertion {
  id: string;
  estimate: string;
  job: JobState;
  files?: OutputFile[];
}
