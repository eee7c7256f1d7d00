// The path tracer's picture: asked for, on its way, there.

import { useState } from 'preact/hooks';

import { addressOf, deleteInsertion, getInsertion, insertObject } from '../api/client.ts';
import { sentenceOf } from '../api/failure.ts';
import type { Insertion, InsertionRequest, JobState } from '../api/types.ts';
import { useJob } from './job.ts';

export interface Rendering {
  job?: JobState; // while it is on its way
  done?: Insertion;
  trouble?: string;
  start(request: InsertionRequest): Promise<void>;
  cancel(): void;
}

export function useRendering(estimate: string, onDone: () => void): Rendering {
  const [id, setId] = useState<string | null>(null);
  const [asking, setAsking] = useState(false);
  const [refusal, setRefusal] = useState<string>();
  const { thing, job, trouble } = useJob(id, {
    get: getInsertion,
    events: addressOf.insertionEvents,
    onEnd: (end) => end.state === 'done' && onDone(),
  });
  const on = job?.state === 'waiting' || job?.state === 'running';
  const sentence = refusal ?? trouble ?? job?.error?.message;
  const waiting: JobState = { state: 'waiting', elapsed_seconds: 0 };
  return {
    ...((asking || on) && { job: job && on ? job : waiting }),
    ...(thing?.job.state === 'done' && { done: thing }),
    ...(sentence !== undefined && { trouble: sentence }),
    start: async (request) => {
      setAsking(true);
      setRefusal(undefined);
      try {
        setId((await insertObject(estimate, request)).id);
      } catch (error) {
        setRefusal(sentenceOf(error));
      }
      setAsking(false);
    },
    cancel: () => {
      if (id === null) return;
      setId(null);
      deleteInsertion(id).catch((error: unknown) => setRefusal(sentenceOf(error)));
    },
  };
}
