// SPDX-License-Identifier: BSD-3-Clause
// What verbs do that end with one answer: it is found under the limits, written as JSON and drawn, its summary printed.
// What is on disk says the same as the exit code: a stop while something is written makes it a stopped answer.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pictures/model/picture_options.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/answer/answer.hpp"
#include "solve/answer/by_products.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/paths/path_file_io.hpp"
#include "tools/screen/run_of_verb.hpp"

namespace warren::tools {

/// --json --no-path --picture, and how a picture looks
std::vector<OptionSpec> answer_output_specs();

class AnswerCommand : NotCopied {
 public:
  /// `keep`: the option whose file takes the roadmap, if it is given. Throws UsageError, WriteError for outputs that
  /// can't be.
  AnswerCommand(const Arguments& arguments, std::string_view keep);
  virtual ~AnswerCommand() = default;
  /// The exit code.
  int run();

 protected:
  /// The answer, for a world with that name; stops may be thrown. `before`: what reading took. `keep`: for a picture.
  virtual Answer find(const Run& run, StageTimes& before, ByProducts* keep) = 0;
  /// The world of the picture, which needs it no more, and what find() has left out of `keep`.
  virtual Scene scene_drawn(const Execution& execution, ByProducts& keep) = 0;
  /// Fills in answer.explained; only after find(), with what that has kept. Throws Stopped.
  virtual void explain(const Execution& /*execution*/, Answer& /*answer*/, ByProducts& /*keep*/) {}
  /// All stages to come, where they are known.
  virtual ExpectedStages expected_stages() const { return {}; }
  /// Throws UsageError where the path of this body can't be written, or it can't be drawn, as it was asked for; find()
  /// calls it.
  void check_outputs_of(const RobotSpec& robot) const;
  bool keeps_roadmap() const { return !roadmap_.empty(); }
  /// Takes the path where nobody needs its points but a file that is written in their order; nullptr elsewhere. Only
  /// find() calls it.
  PathTaker* path_taker() { return handed_on_ ? &*handed_on_ : nullptr; }

  const Arguments& arguments_;
  Roadmap made_roadmap_;  ///< what goes to the file of `keep`: find() makes it

 private:
  void answer(const Run& run);
  bool hands_path_on() const;
  void write_outputs(Run& run);
  void write_finished(const Execution& execution);
  void write_json(std::optional<OutputFile>& file, const Execution& execution) const;
  void write_kept(std::optional<OutputFile>& file, const Execution& execution) const;
  void draw(const Execution& execution);
  bool explains() const { return arguments_.has("--explain"); }

  std::string json_;
  std::string svg_;
  std::string roadmap_;
  std::string path_;
  std::string certificate_;  // where the proof of a bound goes; empty: nowhere
  std::optional<PathArrayFile> handed_on_;
  PathFileOptions path_options_;
  PictureOptions picture_options_;
  ByProducts by_products_;
  Answer answer_;
  std::vector<std::string> written_;
  std::vector<std::string> drawn_otherwise_;  // what write_picture() said
  bool json_said_ = false;                    ///< some of it is where it can't be taken back
};

}  // namespace warren::tools
