// Whether this browser can draw in 3D at all. Costs a context, so it is asked once.

let answer: boolean | undefined;

export function hasWebGl(): boolean {
  if (answer === undefined) {
    const context = document.createElement('canvas').getContext('webgl2');
    context?.getExtension('WEBGL_lose_context')?.loseContext();
    answer = context !== null;
  }
  return answer;
}
