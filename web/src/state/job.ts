// An estimate or an insertion, followed from its first moment to its end.

import { useEffect, useState } from 'preact/hooks';

import { isOver, watchJob } from '../api/events.ts';
import { Failure, sentenceOf } from '../api/failure.ts';
import type { JobState } from '../api/types.ts';

interface Followed<T> {
  thing?: T; // as last fetched: when it was found, and at its end
  job?: JobState; // as last told
  trouble?: string; // the server does not answer, or knows of no such thing
}

interface Source<T> {
  get(id: string): Promise<T>;
  events(id: string): string;
  onEnd?(job: JobState): void;
}

export function useJob<T extends { job: JobState }>(id: string | null, source: Source<T>): Followed<T> {
  const [followed, setFollowed] = useState<Followed<T> & { id: string | null }>({ id: null });
  useEffect(() => {
    if (id === null) return;
    let wanted = true;
    let stop = () => {};
    const told = (job: JobState) => {
      if (wanted)
        setFollowed((before) => ({ ...(before.id === id && before.thing ? { thing: before.thing } : {}), job, id }));
    };
    const fetched = async () => {
      try {
        const thing = await source.get(id);
        if (wanted) setFollowed({ thing, job: thing.job, id });
        return thing.job;
      } catch (error) {
        const trouble = sentenceOf(error);
        if (error instanceof Failure && error.kind === 'not_found') stop();
        if (wanted) setFollowed((before) => ({ ...(before.id === id ? before : {}), trouble, id }));
        return undefined;
      }
    };
    const ended = async () => {
      stop();
      const job = await fetched();
      if (wanted && job) source.onEnd?.(job);
    };
    void fetched().then((job) => {
      if (!wanted || !job || isOver(job)) return;
      stop = watchJob(source.events(id), {
        onState: (now) => (isOver(now) ? ended() : told(now)),
        onBreak: async () => {
          const now = await fetched();
          if (wanted && now && isOver(now)) await ended();
        },
      });
    });
    return () => {
      wanted = false;
      stop();
    };
  }, [id]);
  return followed.id === id ? followed : {};
}
