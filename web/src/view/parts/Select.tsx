import { useId } from 'preact/hooks';

interface Props {
  label: string;
  options: readonly { value: string; text: string }[];
  value: string;
  onChange(value: string): void;
}

export function Select({ label, options, value, onChange }: Props) {
  const id = useId();
  return (
    <div class="select">
      <label for={id}>{label}</label>
      <select id={id} value={value} onChange={(event) => onChange(event.currentTarget.value)}>
        {options.map((option) => (
          <option key={option.value} value={option.value}>
            {option.text}
          </option>
        ))}
      </select>
    </div>
  );
}
