// The server's API, one function an operation. Each throws a Failure and nothing else.

import { Failure } from './failure.ts';
import type {
  Estimate,
  EstimateSummary,
  FailureBody,
  Info,
  Insertion,
  InsertionRequest,
  ObjectModel,
} from './types.ts';

const root = '/api/v1';

export const addressOf = {
  sample: (name: string) => `${root}/samples/${encodeURIComponent(name)}`,
  photo: (id: string) => `${root}/estimates/${id}/photo`,
  file: (id: string, path: string) => `${root}/estimates/${id}/files/${escaped(path)}`,
  archive: (id: string) => `${root}/estimates/${id}/archive.zip`,
  estimateEvents: (id: string) => `${root}/estimates/${id}/events`,
  insertionFile: (id: string, path: string) => `${root}/insertions/${id}/files/${escaped(path)}`,
  insertionEvents: (id: string) => `${root}/insertions/${id}/events`,
};

export const getInfo = () => getJson<Info>('/info');
export const getObject = (name: string) => getJson<ObjectModel>(`/objects/${encodeURIComponent(name)}`);
export const listEstimates = () => getJson<EstimateSummary[]>('/estimates');
export const getEstimate = (id: string) => getJson<Estimate>(`/estimates/${id}`);
export const deleteEstimate = (id: string) => remove(`/estimates/${id}`);
export const getInsertion = (id: string) => getJson<Insertion>(`/insertions/${id}`);
export const deleteInsertion = (id: string) => remove(`/insertions/${id}`);

export function estimatePhoto(photo: Blob, name: string): Promise<Estimate> {
  // Always this type: what the photo is, the server reads from its bytes.
  return post(`/estimates?name=${encodeURIComponent(name)}`, 'application/octet-stream', photo);
}

export function estimateSample(sample: string, title: string): Promise<Estimate> {
  return post(`/estimates?name=${encodeURIComponent(title)}`, 'application/json', JSON.stringify({ sample }));
}

export function insertObject(estimate: string, request: InsertionRequest): Promise<Insertion> {
  return post(`/estimates/${estimate}/insertions`, 'application/json', JSON.stringify(request));
}

export async function getBytes(address: string): Promise<ArrayBuffer> {
  const response = await answerOf(address);
  return response.arrayBuffer();
}

async function getJson<T>(path: string): Promise<T> {
  return jsonOf<T>(await answerOf(root + path, { headers: { accept: 'application/json' } }));
}

async function post<T>(path: string, type: string, body: BodyInit): Promise<T> {
  return jsonOf<T>(await answerOf(root + path, { method: 'POST', headers: { 'content-type': type }, body }));
}

async function remove(path: string): Promise<void> {
  await answerOf(root + path, { method: 'DELETE' });
}

async function answerOf(address: string, init?: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(address, init);
  } catch {
    throw Failure.gone();
  }
  if (!response.ok) throw await failureOf(response);
  return response;
}

async function jsonOf<T>(response: Response): Promise<T> {
  try {
    return (await response.json()) as T;
  } catch {
    throw Failure.gone();
  }
}

async function failureOf(response: Response): Promise<Failure> {
  try {
    const body = (await response.json()) as { error: FailureBody };
    return Failure.of(body.error);
  } catch {
    return new Failure('unexpected', `The server answered ${response.status} without saying why.`);
  }
}

// Slashes of a path stay.
function escaped(path: string): string {
  return path.split('/').map(encodeURIComponent).join('/');
}
