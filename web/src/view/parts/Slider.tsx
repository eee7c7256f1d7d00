import { useId } from 'preact/hooks';

interface Props {
  label: string;
  value: number;
  min: number;
  max: number;
  step: number;
  text: string; // the value for people
  onInput(value: number): void;
}

export function Slider({ label, value, min, max, step, text, onInput }: Props) {
  const id = useId();
  return (
    <div class="slider">
      <label for={id}>{label}</label>
      <output for={id}>{text}</output>
      <input
        id={id}
        type="range"
        min={min}
        max={max}
        step={step}
        value={value}
        aria-valuetext={text}
        onInput={(event) => onInput(event.currentTarget.valueAsNumber)}
      />
    </div>
  );
}

// Equal steps are equal factors: for lengths.
export function LengthSlider(props: {
  label: string;
  value: number;
  min: number;
  max: number;
  text: string;
  onInput(value: number): void;
}) {
  const { value, min, max, onInput, ...rest } = props;
  return (
    <Slider
      {...rest}
      value={Math.log2(value)}
      min={Math.log2(min)}
      max={Math.log2(max)}
      step={0.01}
      onInput={(log) => onInput(2 ** log)}
    />
  );
}
