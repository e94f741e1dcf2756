// SPDX-License-Identifier: Apache-2.0
#include "openimageio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace kiln::io::module {

struct Reader {
  Reader(const void* bytes, size_t count) : source(const_cast<void*>(bytes), count) {}

  OIIO::Filesystem::IOMemReader source;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::TypeDesc type;
  std::vector<std::pair<std::string, std::string>> texts;
};

// What the library writes, on its way to the other side.
class Target : public OIIO::Filesystem::IOProxy {
 public:
  explicit Target(const Sink& sink) : IOProxy("", Write), sink_(sink) {}

  const char* proxytype() const override { return "kiln"; }
  size_t write(const void* bytes, size_t count) override {
    const size_t written = pwrite(bytes, count, m_pos);
    m_pos += static_cast<int64_t>(written);
    return written;
  }
  size_t pwrite(const void* bytes, size_t count, int64_t place) override {
    const auto first = static_cast<uint64_t>(place);
    sink_.write(sink_.self, first, bytes, count);
    size_ = std::max(size_, first + count);
    return count;
  }
  size_t size() const override { return size_; }

 private:
  Sink sink_;
  uint64_t size_ = 0;
};

struct Writer {
  explicit Writer(const Sink& sink) : target(sink) {}

  Target target;
  std::unique_ptr<OIIO::ImageOutput> output;
  OIIO::ImageSpec spec;
};

namespace {

std::string& error_text() {
  thread_local std::string text;
  return text;
}

// Runs `work`; whatever it throws becomes the thread's last error, and the result a default one.
template <class Result, class Work>
Result guarded(Work&& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    error_text() = error.what();
  } catch (...) {
    error_text() = "unknown failure";
  }
  return Result{};
}

[[noreturn]] void fail(const std::string& reason) {
  throw std::runtime_error(reason.empty() ? "unknown failure" : reason);
}

// The samples that cross the seam: the file's own where they are one of ours, else float.
OIIO::TypeDesc sample_type(const OIIO::ImageSpec& spec, PixelType& type) {
  const auto formats = spec.channelformats;
  const bool mixed = std::any_of(formats.begin(), formats.end(),
                                 [&](const OIIO::TypeDesc& t) { return t != spec.format; });
  type = PixelType::Float;
  if (mixed) return OIIO::TypeFloat;
  if (spec.format == OIIO::TypeUInt8) type = PixelType::Uint8;
  if (spec.format == OIIO::TypeUInt16) type = PixelType::Uint16;
  if (spec.format == OIIO::TypeHalf) type = PixelType::Half;
  return type == PixelType::Float ? OIIO::TypeFloat : spec.format;
}

void describe(const OIIO::ImageSpec& spec, StoredImage& stored) {
  stored.width = spec.width;
  stored.height = spec.height;
  stored.channels = spec.nchannels;
  stored.block_rows = spec.tile_width > 0 ? spec.tile_height : 1;
  stored.orientation = std::clamp(spec.get_int_attribute("Orientation", 1), 1, 8);
  stored.alpha_channel = spec.alpha_channel;
  stored.premultiplied =
      spec.alpha_channel >= 0 && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0 ? 1 : 0;
}

Reader* open(const char* format, const void* bytes, size_t count, StoredImage* stored) {
  return guarded<Reader*>([&] {
    auto reader = std::make_unique<Reader>(bytes, count);
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    wishes.attribute("oiio:RawColor", 1);
    reader->input = OIIO::ImageInput::create(format, false, &wishes, &reader->source);
    if (!reader->input) fail(OIIO::geterror());
    reader->input->set_ioproxy(&reader->source);
    OIIO::ImageSpec spec;
    // The name only shows in messages; nothing is opened by it.
    if (!reader->input->open(std::string("image.") + format, spec, wishes)) {
      fail(reader->input->geterror());
    }
    describe(spec, *stored);
    reader->type = sample_type(spec, stored->type);
    for (const OIIO::ParamValue& value : spec.extra_attribs) {
      if (value.type() == OIIO::TypeString) {
        reader->texts.emplace_back(value.name().string(), value.get_string());
      }
    }
    return reader.release();
  });
}

const char* channel_name(const Reader* reader, int channel) {
  return reader->input->spec().channelnames[static_cast<size_t>(channel)].c_str();
}

Attribute text(Reader* reader, int n) {
  if (n < 0 || n >= static_cast<int>(reader->texts.size())) return {nullptr, nullptr};
  const auto& [name, value] = reader->texts[static_cast<size_t>(n)];
  return {name.c_str(), value.c_str()};
}

bool read_rows(Reader* reader, int first, int count, void* samples) {
  return guarded<bool>([&] {
    OIIO::ImageInput& input = *reader->input;
    const OIIO::ImageSpec& spec = input.spec();
    const int begin = spec.y + first;
    const int end = begin + count;
    const bool read = spec.tile_width > 0
                          ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z,
                                             spec.z + 1, 0, spec.nchannels, reader->type, samples)
                          : input.read_scanlines(0, 0, begin, end, spec.z, 0, spec.nchannels,
                                                 reader->type, samples);
    if (!read || input.has_error()) fail(input.geterror());
    return true;
  });
}

void close(Reader* reader) {
  guarded<bool>([&] {
    delete reader;
    return true;
  });
}

OIIO::TypeDesc library_type(PixelType type) {
  switch (type) {
    case PixelType::Uint8:
      return OIIO::TypeUInt8;
    case PixelType::Uint16:
      return OIIO::TypeUInt16;
    case PixelType::Half:
      return OIIO::TypeHalf;
    case PixelType::Float:
    case PixelType::Rgb10a2:
    case PixelType::Rgbd8:
    case PixelType::B10g11r11:
    case PixelType::E5b9g9r9:
      return OIIO::TypeFloat;
  }
  return OIIO::TypeFloat;
}

// Settings that make the bytes a function of the image alone.
void settle(OIIO::ImageSpec& spec, const std::string& format, bool fast) {
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("oiio:RawColor", 1);
  if (format == "png") spec.attribute("png:compressionLevel", fast ? 3 : 6);
  constexpr int sub_filter = 16;  // of libpng: to the left neighbour, whatever the row
  if (format == "png" && fast) spec.attribute("png:filter", sub_filter);
  if (format == "jpeg") {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  if (format == "tiff") {
    spec.attribute("compression", "zip");
    spec.attribute("tiff:zipquality", 6);
    spec.attribute("tiff:half", 1);                     // else half is written as float
    spec.attribute("DateTime", "1970:01:01 00:00:00");  // else the writer stamps the time of day
  }
}

Writer* create(const WrittenImage* image, const Sink* sink) {
  return guarded<Writer*>([&] {
    auto writer = std::make_unique<Writer>(*sink);
    writer->spec =
        OIIO::ImageSpec(image->width, image->height, image->channels, library_type(image->type));
    writer->spec.alpha_channel = image->alpha_channel;
    for (int i = 0; i < image->text_count; ++i) {
      writer->spec.attribute(image->texts[i].name, image->texts[i].text);
    }
    settle(writer->spec, image->format, image->fast != 0);
    writer->output = OIIO::ImageOutput::create(image->format, &writer->target);
    if (!writer->output) fail(OIIO::geterror());
    writer->output->set_ioproxy(&writer->target);
    if (!writer->output->open(std::string("image.") + image->format, writer->spec)) {
      fail(writer->output->geterror());
    }
    return writer.release();
  });
}

bool write_rows(Writer* writer, int first, int count, const void* samples) {
  return guarded<bool>([&] {
    if (!writer->output->write_scanlines(first, first + count, 0, writer->spec.format, samples)) {
      fail(writer->output->geterror());
    }
    return true;
  });
}

bool finish(Writer* writer) {
  return guarded<bool>([&] {
    if (!writer->output->close()) fail(writer->output->geterror());
    return true;
  });
}

void drop(Writer* writer) {
  guarded<bool>([&] {
    delete writer;
    return true;
  });
}

const char* last_error() { return error_text().c_str(); }

}  // namespace
}  // namespace kiln::io::module

extern "C" const kiln::io::module::Face* kiln_openimageio() {
  using namespace kiln::io::module;
  static const Face face{face_version, open,       channel_name, text, read_rows, close,
                         create,       write_rows, finish,       drop, last_error};
  static const bool one_thread = OIIO::attribute("threads", 1);
  static_cast<void>(one_thread);
  return &face;
}
