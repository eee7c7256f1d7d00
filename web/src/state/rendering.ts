// The path tracer's picture: asked for, on its way, there.

import { useRef, useState } from 'preact/hooks';

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
  const unwanted = useRef(false); // cancelled before the server had answered
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
      unwanted.current = false;
      setId(null);
      setAsking(true);
      setRefusal(undefined);
      try {
        const made = await insertObject(estimate, request);
        if (unwanted.current) await deleteInsertion(made.id);
        else setId(made.id);
      } catch (error) {
        setRefusal(sentenceOf(error));
      }
      setAsking(false);
    },
    cancel: () => {
      unwanted.current = true;
      if (id === null) return;
      setId(null);
      deleteInsertion(id).catch((error: unknown) => setRefusal(sentenceOf(error)));
    },
  };
}
